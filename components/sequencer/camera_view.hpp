#pragma once
#include "core/config/fields.hpp"
#include "core/intrinsics.hpp"
#include "core/pose.hpp"

namespace coop::sequencer {

struct CameraViewConfig {
  double margin = 0.06;   ///< m: nearer to the picture's border an egg may be cut
  double distance = 1.8;  ///< m from the camera: farther eggs may be missed or hidden

  void describe(config::Fields& fields);
};

/// What one picture shows of the floor.
struct CameraView {
  Pose3 camera_in_map = Pose3::Identity();  ///< the optical frame
  Intrinsics intrinsics;

  /// Whether an egg at that place of the floor, known to within `stddev` (m), must be seen: it is
  /// near, and whole in the picture. What may stand before it is not known here.
  [[nodiscard]] bool shows(const Eigen::Vector2d& place_in_map, double stddev,
                           const CameraViewConfig& config) const;
};

}  // namespace coop::sequencer
