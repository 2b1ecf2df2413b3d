#pragma once
#include <vector>

#include "core/pose.hpp"
#include "global_planner/reeds_shepp.hpp"

namespace coop::global_planner {

/// How far a car has to drive from one pose to another without obstacles, looked up in a table over
/// the pose relative to the goal (0.2 m, 10 degrees) that fills as it is used. Beyond the table's
/// reach it answers with zero: far from the goal the turning circle matters little.
class TurningDistance {
 public:
  explicit TurningDistance(double turning_radius, double reach = 4.0);

  /// Metres from `from` to `to`, up to the table's rounding.
  [[nodiscard]] double operator()(const Pose2& from, const Pose2& to);

 private:
  ReedsShepp curves_;
  double reach_;
  int side_;                  ///< cells along the table's edge
  std::vector<float> table_;  ///< negative: not yet computed
};

}  // namespace coop::global_planner
