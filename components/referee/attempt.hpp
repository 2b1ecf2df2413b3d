#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"

namespace coop::referee {

/// Why an attempt did not bring the egg into the arm's working range.
enum class Cause {
  kNone,               ///< it did
  kNotSeen,            ///< the mission never knew of the egg
  kNotTried,           ///< known, but the mission ended before its turn, or struck it off
  kFalseEgg,           ///< no egg lies near where the mission has one
  kEggBroken,          ///< under a wheel, or fallen
  kNoFreePose,         ///< no pose around the egg that the robot could take
  kNoPath,             ///< the planner gave the goal up
  kDriverGaveUp,       ///< the driver gave the goal up
  kCollision,          ///< the robot ran into something, and did not arrive
  kTimedOut,           ///< the mission gave up waiting
  kMissionEnded,       ///< the mission ended on the way
  kLocalisationError,  ///< arrived; the robot is not where it thinks it is
  kEggPositionError,   ///< arrived; the egg is not where the mission thinks it is
  kControlError,       ///< arrived; the robot did not stop where it was told to
  kErrorsTogether,     ///< arrived; none of the three errors explains the miss alone
};

[[nodiscard]] std::string_view to_string(Cause cause);

/// Where the egg lay on arrival, and whose error that was. All in base_link, m.
struct Arrival {
  Time stamp{};
  Eigen::Vector2d egg_in_base{0, 0};
  Eigen::Vector2d deviation{0, 0};   ///< egg minus working point: the sum of the three parts below
  Eigen::Vector2d by_control{0, 0};  ///< believed egg from the believed pose, minus the point
  Eigen::Vector2d by_egg{0, 0};      ///< true minus believed egg, from the believed pose
  Eigen::Vector2d by_localisation{0, 0};  ///< true egg from the true minus from the believed pose
  double heading_error = 0.0;             ///< rad, bearing of the egg
  double position_error = 0.0;            ///< m, of the believed pose
  double yaw_error = 0.0;                 ///< rad, of the believed pose, believed minus true
};

/// One goal set for one egg, and what became of it.
struct Attempt {
  std::string egg;          ///< in the simulated world; empty: a false egg
  std::string mission_egg;  ///< as the mission calls it; empty: it never knew
  int try_number = 0;       ///< of this egg, from 1; 0: never tried
  Time start{};
  Time end{};
  double path_length = 0.0;  ///< m, truly driven up to arrival
  std::optional<Arrival> arrival;
  bool in_range = false;  ///< on arrival, in the arm's working range: the paper's success
  bool picked = false;
  std::uint32_t collisions = 0;  ///< begun between start and end
  Cause cause = Cause::kNone;
  std::string detail;  ///< the mission's own words
};

/// Columns of attempts.csv, and a row of it. Times are s of simulated time, lengths m, angles rad.
[[nodiscard]] std::vector<std::string> attempt_columns();
[[nodiscard]] std::vector<std::string> to_row(const Attempt& attempt, std::uint64_t seed,
                                              int number);

}  // namespace coop::referee
