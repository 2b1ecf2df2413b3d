#include "core/health_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <ctime>
#include <tuple>

#include "core/atomic_file.hpp"
#include "core/name.hpp"
#include "core/runtime_folder.hpp"

namespace coop {
namespace {

constexpr std::string_view kEnding = ".state";
/// A note is four short lines; what is longer is none.
constexpr std::size_t kLongestReason = 400;
constexpr std::uintmax_t kLongestNote = 1024;

template <class Number>
bool parse_number(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

bool set_line(HealthNote& note, std::string_view key, std::string_view value) {
  if (key == "state") {
    note.state = value;
  } else if (key == "reason") {
    note.reason = value;
  } else if (key == "pid") {
    return parse_number(value, note.pid);
  } else if (key == "stamp") {
    return parse_number(value, note.stamp);
  }
  return true;
}

/// DOMAIN[-ROBOT]; nothing for another name.
std::optional<std::pair<int, std::string>> parse_system(std::string_view text) {
  const std::size_t dash = std::min(text.find('-'), text.size());
  int domain = 0;
  if (!parse_number(text.substr(0, dash), domain)) return std::nullopt;
  return std::pair{domain, std::string(text.substr(std::min(dash + 1, text.size())))};
}

std::optional<FoundHealth> read_health(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const std::size_t dot = name.find('.');
  if (!name.ends_with(kEnding) || dot == 0 || dot + kEnding.size() >= name.size())
    return std::nullopt;
  std::error_code problem;
  if (const auto size = std::filesystem::file_size(file, problem); problem || size > kLongestNote)
    return std::nullopt;
  try {
    auto note = parse_health_note(read_file(file));
    if (!note) return std::nullopt;
    return FoundHealth{name.substr(0, dot),
                       name.substr(dot + 1, name.size() - dot - 1 - kEnding.size()),
                       std::move(*note)};
  } catch (const std::exception&) {
    return std::nullopt;  // its writer has just gone
  }
}

}  // namespace

HealthFile::HealthFile(const std::string& robot, int domain, const std::string& component) {
  if (!is_name(component) || (!robot.empty() && !is_name(robot))) {
    problem_ = "a name that is no file name";
    return;
  }
  for (const auto& folder : runtime_folders()) {
    if (!make_private_folder(folder)) continue;
    path_ = folder / (system_file_stem(robot, domain) + "." + component + std::string(kEnding));
    return;
  }
  problem_ = "no folder for it; COOP_RUNTIME_DIR names one";
}

HealthFile::~HealthFile() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove(path_, ignored);
}

void HealthFile::write(std::string_view state, std::string_view reason) noexcept {
  if (path_.empty()) return;
  try {
    std::string line(reason.substr(0, kLongestReason));
    std::ranges::replace(line, '\n', ' ');
    const std::string text = "state " + std::string(state) + "\nreason " + line + "\npid " +
                             std::to_string(::getpid()) + "\nstamp " + std::to_string(boot_time()) +
                             "\n";
    problem_ = replace_file(path_, text) ? "" : "cannot write " + path_.string();
  } catch (const std::exception&) {
    path_.clear();  // no memory for three lines: there are other worries
  }
}

std::optional<HealthNote> parse_health_note(std::string_view text) {
  HealthNote note;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    const std::size_t space = line.find(' ');
    if (space == std::string_view::npos) return std::nullopt;
    if (!set_line(note, line.substr(0, space), line.substr(space + 1))) return std::nullopt;
  }
  if (note.state.empty() || note.pid <= 0 || note.stamp <= 0) return std::nullopt;
  return note;
}

std::vector<FoundHealth> find_health(std::optional<int> domain,
                                     const std::optional<std::string>& robot) {
  std::vector<FoundHealth> found;
  std::vector<std::filesystem::path> seen;
  for (const auto& folder : runtime_folders()) {
    std::error_code problem;
    const auto canonical = std::filesystem::canonical(folder, problem);
    if (problem || std::ranges::find(seen, canonical) != seen.end()) continue;
    seen.push_back(canonical);
    for (const auto& entry : std::filesystem::directory_iterator(canonical, problem)) {
      auto health = read_health(entry.path());
      const auto system = health ? parse_system(health->system) : std::nullopt;
      if (!system || (domain && *domain != system->first) || (robot && *robot != system->second))
        continue;
      found.push_back(std::move(*health));
    }
  }
  std::ranges::sort(found, {}, [](const FoundHealth& health) {
    return std::tie(health.system, health.component);
  });
  return found;
}

std::string_view to_string(Liveness liveness) {
  switch (liveness) {
    case Liveness::kReady:
      return "ready";
    case Liveness::kDegraded:
      return "degraded";
    case Liveness::kStarting:
      return "starting";
    case Liveness::kStopping:
      return "stopping";
    case Liveness::kStale:
      return "stale";
    case Liveness::kAbsent:
      return "absent";
  }
  return "";
}

Liveness judge_health(const HealthNote& note, std::int64_t now, bool writer_lives) {
  if (!writer_lives) return Liveness::kAbsent;
  // A stamp of the future is of an earlier boot.
  if (note.stamp > now || now - note.stamp > kHealthStaleAfter) return Liveness::kStale;
  if (note.state == "ready") return Liveness::kReady;
  if (note.state == "degraded") return Liveness::kDegraded;
  return note.state == "starting" ? Liveness::kStarting : Liveness::kStopping;
}

std::int64_t boot_time() {
  timespec time{};
  clock_gettime(CLOCK_BOOTTIME, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

}  // namespace coop
