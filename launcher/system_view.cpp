#include "launcher/system_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "launcher/system_lock.hpp"

namespace coop::launcher {
namespace {

std::string duration_text(double seconds) {
  char text[32];
  const auto whole = static_cast<long>(seconds);
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  }
  return text;
}

std::string megabytes(std::uint64_t bytes) {
  return std::to_string(std::lround(static_cast<double>(bytes) / 1e6));
}

std::string percent(double share) {
  return std::to_string(std::lround(100.0 * share));
}

std::string line(std::size_t name_width, const std::string& name, const std::string& state,
                 const std::string& pid, const std::string& up, const std::string& restarts,
                 const std::string& cpu, const std::string& memory, const std::string& detail) {
  char text[512];
  std::snprintf(text, sizeof text, "%-*s  %-11s %8s %9s %9s %6s %7s  ",
                static_cast<int>(name_width), name.c_str(), state.c_str(), pid.c_str(), up.c_str(),
                restarts.c_str(), cpu.c_str(), memory.c_str());
  return text + detail;
}

}  // namespace

std::vector<std::string> format_table(const SystemView& system, std::size_t width) {
  std::size_t name_width = 9;
  for (const Row& row : system.rows) name_width = std::max(name_width, row.name.size());
  std::vector<std::string> lines;
  lines.push_back("coop  " + system_name(system.robot, system.domain) + "  up " +
                  duration_text(system.uptime) + "  " + system.run_folder);
  lines.push_back(
      line(name_width, "COMPONENT", "STATE", "PID", "UP", "RESTARTS", "CPU %", "RSS MB", "DETAIL"));
  double cpu = 0.0;
  std::uint64_t resident = 0;
  for (const Row& row : system.rows) {
    const bool lives = row.pid != 0;
    cpu += row.cpu;
    resident += row.resident;
    lines.push_back(line(name_width, row.name, row.state, lives ? std::to_string(row.pid) : "-",
                         lives ? duration_text(row.uptime) : "-", std::to_string(row.restarts),
                         lives ? percent(row.cpu) : "-", lives ? megabytes(row.resident) : "-",
                         row.detail));
  }
  lines.push_back(line(name_width, "all", "", "", "", "", percent(cpu), megabytes(resident), ""));
  for (std::string& text : lines) {
    if (text.size() > width) text.resize(width);
    text.erase(text.find_last_not_of(' ') + 1);
  }
  return lines;
}

}  // namespace coop::launcher
