#pragma once
#include <vector>

#include "camera_driver/barn_view.hpp"
#include "camera_driver/frame.hpp"
#include "camera_driver/intrinsics.hpp"
#include "camera_driver/pixel_rays.hpp"
#include "camera_driver/sensor_noise.hpp"
#include "camera_driver/solids.hpp"
#include "core/config/fields.hpp"
#include "core/world/state.hpp"

namespace coop::camera_driver {

/// An RGB-D camera of the class of the RealSense D435i.
struct SimulatedCameraConfig {
  int width = 424;         ///< px
  int height = 240;        ///< px
  double range_min = 0.2;  ///< m of depth
  double range_max = 6.0;  ///< m of depth
  SensorNoiseConfig noise;

  void describe(config::Fields& fields);
  void validate() const;  ///< throws config::Error
};

/// Pictures of a simulated world: floor of litter, obstacles as blocks, animals as cylinders, eggs
/// on the floor and in the gripper as ellipsoids, broken ones as puddles. All pixels are of one
/// moment; the robot itself is not in the picture.
class SimulatedCamera {
 public:
  SimulatedCamera(const SimulatedCameraConfig& config, const world::World& world,
                  const Pose3& camera_in_base, std::uint64_t seed);
  SimulatedCamera(const SimulatedCamera&) = delete;
  SimulatedCamera& operator=(const SimulatedCamera&) = delete;

  /// Overwrites `frame`, whose memory is used again.
  void take(const world::GroundTruth& truth, Frame& frame);

  [[nodiscard]] const Intrinsics& intrinsics() const { return rays_.intrinsics(); }

 private:
  void draw_egg(const world::Egg& egg, const Pose2& world_in_robot, cv::Mat& colour);
  void draw_cylinder(const Cylinder& in_base, const Colour& paint, cv::Mat& colour);

  PixelRays rays_;
  BarnView barn_;
  SensorNoise noise_;
  std::vector<float> depth_;  ///< m along the optical axis, exact; 0: nothing
};

}  // namespace coop::camera_driver
