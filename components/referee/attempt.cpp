#include "referee/attempt.hpp"

#include <fmt/format.h>

namespace coop::referee {
namespace {

std::string shown(double value) {
  // Tenths of millimetres, and no minus zero.
  const std::string text = fmt::format("{:.4f}", value);
  return text == "-0.0000" ? "0.0000" : text;
}

std::string shown(Time time) {
  return fmt::format("{:.2f}", to_seconds(time));
}

}  // namespace

std::string_view to_string(Cause cause) {
  switch (cause) {
    case Cause::kNone:
      return "";
    case Cause::kNotSeen:
      return "not seen";
    case Cause::kNotTried:
      return "not tried";
    case Cause::kFalseEgg:
      return "false egg";
    case Cause::kEggBroken:
      return "egg broken";
    case Cause::kNoFreePose:
      return "no free pose";
    case Cause::kNoPath:
      return "no path";
    case Cause::kDriverGaveUp:
      return "driver gave up";
    case Cause::kCollision:
      return "collision";
    case Cause::kTimedOut:
      return "timed out";
    case Cause::kMissionEnded:
      return "mission ended";
    case Cause::kLocalisationError:
      return "localisation error";
    case Cause::kEggPositionError:
      return "egg position error";
    case Cause::kControlError:
      return "control error";
    case Cause::kErrorsTogether:
      return "errors together";
  }
  return "unknown";
}

std::vector<std::string> attempt_columns() {
  return {"seed",
          "attempt",
          "egg",
          "mission_egg",
          "try",
          "start_time",
          "arrival_time",
          "end_time",
          "path_length",
          "egg_x",
          "egg_y",
          "deviation_x",
          "deviation_y",
          "distance",
          "heading_error",
          "in_range",
          "picked",
          "collisions",
          "localisation_error",
          "localisation_yaw_error",
          "control_x",
          "control_y",
          "egg_error_x",
          "egg_error_y",
          "localisation_x",
          "localisation_y",
          "outcome",
          "cause",
          "detail"};
}

std::vector<std::string> to_row(const Attempt& attempt, std::uint64_t seed, int number) {
  std::vector<std::string> row{std::to_string(seed),
                               std::to_string(number),
                               attempt.egg,
                               attempt.mission_egg,
                               std::to_string(attempt.try_number),
                               shown(attempt.start),
                               attempt.arrival ? shown(attempt.arrival->stamp) : "",
                               shown(attempt.end),
                               shown(attempt.path_length)};
  const auto add = [&](double Arrival::*value) {
    row.push_back(attempt.arrival ? shown(*attempt.arrival.*value) : "");
  };
  const auto add_point = [&](Eigen::Vector2d Arrival::*point) {
    for (int i = 0; i < 2; ++i) {
      row.push_back(attempt.arrival ? shown((*attempt.arrival.*point)[i]) : "");
    }
  };
  add_point(&Arrival::egg_in_base);
  add_point(&Arrival::deviation);
  row.push_back(attempt.arrival ? shown(attempt.arrival->deviation.norm()) : "");
  add(&Arrival::heading_error);
  row.emplace_back(attempt.in_range ? "1" : "0");
  row.emplace_back(attempt.picked ? "1" : "0");
  row.push_back(std::to_string(attempt.collisions));
  add(&Arrival::position_error);
  add(&Arrival::yaw_error);
  add_point(&Arrival::by_control);
  add_point(&Arrival::by_egg);
  add_point(&Arrival::by_localisation);
  row.emplace_back(attempt.in_range ? "success" : "failure");
  row.emplace_back(to_string(attempt.cause));
  row.push_back(attempt.detail);
  return row;
}

}  // namespace coop::referee
