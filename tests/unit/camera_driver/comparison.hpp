#pragma once
#include <optional>
#include <vector>

#include "camera_driver/frame.hpp"
#include "camera_driver/intrinsics.hpp"
#include "core/detection.hpp"
#include "core/pose.hpp"
#include "core/world/state.hpp"

/// Detections held against what is true.
namespace coop::camera_driver::test {

struct SeenEgg {
  Eigen::Vector3d in_base{0, 0, 0};    ///< m
  Eigen::Vector3d in_camera{0, 0, 0};  ///< m, optical frame
  bool visible = false;                ///< whole in the picture, nothing before it
  std::optional<Detection> found;      ///< nearest detection within 0.15 m
};

struct Comparison {
  std::vector<SeenEgg> eggs;
  std::vector<Detection> spurious;  ///< with no egg within 0.15 m
};

/// Whole in the picture, and nothing nearer over its outline.
inline bool is_visible(const Eigen::Vector3d& egg, const Frame& frame, const Intrinsics& camera) {
  const Eigen::Vector2d pixel = camera.project(egg);
  const double margin = 0.034 * camera.fx / egg.z();
  if (egg.z() <= 0.1 || pixel.x() < margin || pixel.y() < margin ||
      pixel.x() > camera.width - 1 - margin || pixel.y() > camera.height - 1 - margin) {
    return false;
  }
  for (const int dx : {-1, 0, 1}) {
    for (const int dy : {-1, 0, 1}) {
      const int column = static_cast<int>(pixel.x() + 0.5 + dx * margin * 0.9);
      const int row = static_cast<int>(pixel.y() + 0.5 + dy * margin * 0.9);
      const auto depth = frame.depth.at<std::uint16_t>(row, column);
      if (depth != 0 && 0.001 * depth < egg.z() - 0.12) return false;
    }
  }
  return true;
}

inline Comparison compare(const world::GroundTruth& truth, const std::vector<Detection>& detections,
                          const Frame& frame, const Intrinsics& camera,
                          const Pose3& camera_in_base) {
  constexpr double kSame = 0.15;  // m
  Comparison result;
  std::vector<bool> used(detections.size(), false);
  for (const world::Egg& egg : truth.eggs) {
    SeenEgg seen;
    seen.in_base = to_pose3(truth.robot_in_world).inverse() * egg.position;
    seen.in_camera = camera_in_base.inverse() * seen.in_base;
    seen.visible = is_visible(seen.in_camera, frame, camera);
    double nearest = kSame;
    std::size_t best = detections.size();
    for (std::size_t i = 0; i < detections.size(); ++i) {
      const double distance = (detections[i].position - seen.in_camera).norm();
      if (used[i] || distance >= nearest) continue;
      nearest = distance;
      best = i;
    }
    if (best < detections.size()) {
      used[best] = true;
      seen.found = detections[best];
    }
    result.eggs.push_back(std::move(seen));
  }
  for (std::size_t i = 0; i < detections.size(); ++i) {
    if (!used[i]) result.spurious.push_back(detections[i]);
  }
  return result;
}

}  // namespace coop::camera_driver::test
