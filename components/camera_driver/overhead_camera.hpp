#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "camera_driver/frame.hpp"
#include "camera_driver/overhead_mount.hpp"
#include "camera_driver/sensor_noise.hpp"
#include "core/world/state.hpp"

namespace coop::camera_driver {

/// The robot as it is seen from above: a box on its footprint.
struct RobotBody {
  std::vector<Eigen::Vector2d> footprint;  ///< convex, in base_link, m
  double height = 0.18;                    ///< m
};

/// Colour pictures of a simulated pen from under its ceiling: a concrete floor with wet patches and
/// crumbs of feed, walls as blocks, heaps of manure, the robot, pigs as cylinders. In perspective:
/// what stands up leans outwards in the picture and hides what lies behind it. The world's frame is
/// taken for the map's. All pixels are of one moment.
class OverheadCamera {
 public:
  OverheadCamera(const OverheadMount& mount, const SensorNoiseConfig& noise,
                 const world::World& world, RobotBody robot, std::uint64_t seed);

  /// Overwrites `frame`, whose memory is used again. There is no depth.
  void take(const world::GroundTruth& truth, Frame& frame);

 private:
  void draw_floor(std::uint64_t seed);
  void draw_walls(const OccupancyGrid& grid);
  void draw_heap(const world::Heap& heap, cv::Mat& picture) const;
  void draw_pig(const world::Animal& pig, cv::Mat& picture) const;
  void draw_robot(const Pose2& robot_in_world, cv::Mat& picture) const;
  [[nodiscard]] cv::Point2f project(const Eigen::Vector2d& place, double height) const;
  /// The silhouette of an upright prism on a convex base.
  void draw_prism(const std::vector<Eigen::Vector2d>& base, double height, const cv::Scalar& side,
                  const cv::Scalar& top, cv::Mat& picture) const;

  Intrinsics intrinsics_;
  Pose3 map_in_camera_;
  RobotBody robot_;
  SensorNoise noise_;
  cv::Mat empty_pen_;
};

}  // namespace coop::camera_driver
