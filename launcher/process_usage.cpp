#include "launcher/process_usage.hpp"

#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

namespace coop::launcher {
namespace {

/// A shorter interval than this gives the share of the one before: the kernel counts in ticks of 10
/// ms.
constexpr double kShortestInterval = 2.0;

}  // namespace

std::optional<double> starved_seconds(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/schedstat");
  double running = 0.0;
  double waiting = 0.0;
  if (!(file >> running >> waiting)) return std::nullopt;
  return 1e-9 * waiting;
}

std::optional<Usage> UsageMeter::sample(pid_t pid, Instant now) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(file, line) || line.rfind(')') == std::string::npos) {
    last_.erase(pid);
    return std::nullopt;
  }
  // Behind the name in brackets: state is field 3, utime 14, stime 15, rss 24 (proc(5)).
  std::istringstream fields(line.substr(line.rfind(')') + 1));
  std::string skipped;
  for (int field = 3; field < 14; ++field) fields >> skipped;
  double user = 0.0;
  double system = 0.0;
  fields >> user >> system;
  for (int field = 16; field < 24; ++field) fields >> skipped;
  std::uint64_t pages = 0;
  fields >> pages;

  Usage usage;
  usage.cpu_seconds = (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  usage.resident = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  const auto [entry, is_new] = last_.try_emplace(pid, Last{now, usage.cpu_seconds, 0.0});
  const double interval = std::chrono::duration<double>(now - entry->second.when).count();
  if (!is_new && interval >= kShortestInterval) {
    entry->second = {now, usage.cpu_seconds,
                     (usage.cpu_seconds - entry->second.cpu_seconds) / interval};
  }
  usage.cpu = entry->second.cpu;
  return usage;
}

}  // namespace coop::launcher
