#pragma once
#include <cstddef>
#include <vector>

#include "core/pose.hpp"

namespace coop::amcl {

/// Hypotheses of the robot's pose in the map, as a structure of arrays so that the inner loops run
/// over flat floats (a float resolves 4 micrometres in a map of 60 m). Weights sum to 1 after a
/// filter step.
struct ParticleSet {
  std::vector<float> x;       ///< m
  std::vector<float> y;       ///< m
  std::vector<float> yaw;     ///< rad, in [-pi, pi)
  std::vector<float> weight;  ///< not negative

  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] bool empty() const { return x.empty(); }
  [[nodiscard]] Pose2 pose(std::size_t i) const { return {x[i], y[i], yaw[i]}; }

  void reserve(std::size_t count) {
    for (auto* column : {&x, &y, &yaw, &weight}) column->reserve(count);
  }
  void clear() {
    for (auto* column : {&x, &y, &yaw, &weight}) column->clear();
  }
  void copy_pose(std::size_t i, const ParticleSet& from) {
    x[i] = from.x[i];
    y[i] = from.y[i];
    yaw[i] = from.yaw[i];
  }
  void push_back(const Pose2& pose, float w) {
    x.push_back(static_cast<float>(pose.x));
    y.push_back(static_cast<float>(pose.y));
    yaw.push_back(static_cast<float>(pose.yaw));
    weight.push_back(w);
  }
};

}  // namespace coop::amcl
