#include "sequencer/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/atomic_file.hpp"
#include "core/hash.hpp"

namespace coop::sequencer {

using nlohmann::json;

namespace {

constexpr std::size_t kChecksumDigits = 16;

std::string checksum(std::string_view text) {
  return fmt::format("{:016x}", fnv1a(text));
}

json to_json(const Pose2& pose) {
  return json::array({pose.x, pose.y, pose.yaw});
}
Pose2 pose_from(const json& value) {
  return {value.at(0), value.at(1), value.at(2)};
}

/// JSON knows no infinity and writes null.
double cost_from(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

json to_json(const EggTask& egg) {
  return {{"id", egg.id},
          {"at", {egg.egg_in_map.x(), egg.egg_in_map.y()}},
          {"phase", static_cast<int>(egg.phase)},
          {"attempts", egg.attempts},
          {"unseen", egg.unseen},
          {"tried", egg.tried_headings},
          {"reason", egg.reason}};
}

EggTask egg_from(const json& value) {
  EggTask egg;
  egg.id = value.at("id");
  egg.egg_in_map = {value.at("at").at(0).get<double>(), value.at("at").at(1).get<double>()};
  egg.phase = static_cast<EggPhase>(value.at("phase").get<int>());
  egg.attempts = value.at("attempts");
  egg.unseen = value.at("unseen");
  egg.tried_headings = value.at("tried").get<std::vector<double>>();
  egg.reason = value.at("reason");
  return egg;
}

json to_json(const MissionState& state) {
  json waypoints = json::array();
  for (const Waypoint& waypoint : state.waypoints) {
    waypoints.push_back({{"name", waypoint.name}, {"pose", to_json(waypoint.pose_in_map)}});
  }
  json eggs = json::array();
  for (const EggTask& egg : state.eggs) eggs.push_back(to_json(egg));
  return {{"mission", state.mission_id},
          {"kind", static_cast<int>(state.kind)},
          {"phase", static_cast<int>(state.phase)},
          {"resume_phase", static_cast<int>(state.resume_phase)},
          {"detail", state.detail},
          {"waypoints", waypoints},
          {"next_waypoint", state.next_waypoint},
          {"searches", state.searches},
          {"missed", state.missed_waypoints},
          {"eggs", eggs},
          {"order", state.order},
          {"tour_cost", state.tour_cost},
          {"tour_cost_alternative", state.tour_cost_alternative},
          {"current_egg", state.current_egg},
          {"pick_id", state.pick_id},
          {"goal_id", state.goal_id},
          {"has_home", state.has_home},
          {"home", to_json(state.home_in_map)}};
}

MissionState state_from(const json& value) {
  MissionState state;
  state.mission_id = value.at("mission");
  state.kind = static_cast<MissionKind>(value.at("kind").get<int>());
  state.phase = static_cast<MissionPhase>(value.at("phase").get<int>());
  state.resume_phase = static_cast<MissionPhase>(value.at("resume_phase").get<int>());
  state.detail = value.at("detail");
  for (const json& waypoint : value.at("waypoints")) {
    state.waypoints.push_back({waypoint.at("name"), pose_from(waypoint.at("pose"))});
  }
  state.next_waypoint = value.at("next_waypoint");
  state.searches = value.at("searches");
  state.missed_waypoints = value.at("missed").get<std::vector<std::string>>();
  for (const json& egg : value.at("eggs")) state.eggs.push_back(egg_from(egg));
  state.order = value.at("order").get<std::vector<std::string>>();
  state.tour_cost = cost_from(value.at("tour_cost"));
  state.tour_cost_alternative = cost_from(value.at("tour_cost_alternative"));
  state.current_egg = value.at("current_egg");
  state.pick_id = value.at("pick_id");
  state.goal_id = value.at("goal_id");
  state.has_home = value.at("has_home");
  state.home_in_map = pose_from(value.at("home"));
  return state;
}

}  // namespace

std::string to_line(const MissionState& state) {
  const std::string text = to_json(state).dump(-1, ' ', true, json::error_handler_t::replace);
  return checksum(text) + " " + text + "\n";
}

std::optional<MissionState> from_line(std::string_view line) {
  if (line.size() < kChecksumDigits + 2) return std::nullopt;
  const std::string_view text = line.substr(kChecksumDigits + 1);
  if (checksum(text) != line.substr(0, kChecksumDigits)) return std::nullopt;
  try {
    return state_from(json::parse(text));
  } catch (const json::exception&) {
    return std::nullopt;  // written by another version
  }
}

Journal::Journal(std::filesystem::path path) : path_(std::move(path)) {
  if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path());
  fd_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (fd_ < 0) {
    throw std::system_error(errno, std::generic_category(), "cannot open " + path_.string());
  }
}

Journal::~Journal() {
  ::close(fd_);
}

bool Journal::append(const MissionState& state) {
  // The line break in front ends a line that an earlier death or a full disk cut short.
  const std::string line = "\n" + to_line(state);
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t written = ::write(fd_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fdatasync(fd_) == 0;
}

std::optional<MissionState> Journal::read(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  return last_state(read_file(path));
}

std::optional<MissionState> Journal::last_state(std::string_view content) {
  std::string_view rest = content;
  while (!rest.empty()) {
    const std::size_t end = rest.find_last_not_of('\n');
    if (end == std::string_view::npos) break;
    rest = rest.substr(0, end + 1);
    const std::size_t begin = rest.find_last_of('\n');
    const std::string_view line = begin == std::string_view::npos ? rest : rest.substr(begin + 1);
    if (auto state = from_line(line)) return state;
    if (begin == std::string_view::npos) break;
    rest = rest.substr(0, begin);
  }
  return std::nullopt;
}

}  // namespace coop::sequencer
