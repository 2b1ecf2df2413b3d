#pragma once
#include <sensor_msgs/msg/CameraInfo.h>
#include <sensor_msgs/msg/Image.h>
#include <vision_msgs/msg/Detection3DArray.h>

#include <optional>
#include <string>

#include "camera_driver/overhead_camera.hpp"
#include "camera_driver/pen_detector.hpp"
#include "runtime/world_feed.hpp"

namespace coop::camera_driver {

struct CameraDriverConfig;

/// A camera above the simulator's world, one picture for the first ground truth at or after each
/// multiple of the frame period; the pigs and the manure found in it are told in map.
class OverheadBackend {
 public:
  OverheadBackend(runtime::Node& node, const CameraDriverConfig& config, const RobotBody& robot);

 private:
  void measure(const world::GroundTruth& truth);
  void publish_picture();

  OverheadMount mount_;
  PenDetector detector_;
  std::optional<OverheadCamera> camera_;
  Frame frame_;
  runtime::Publisher<sensor_msgs::msg::Image> picture_;
  runtime::Publisher<sensor_msgs::msg::CameraInfo> info_;
  runtime::Publisher<vision_msgs::msg::Detection3DArray> animals_;
  runtime::Publisher<vision_msgs::msg::Detection3DArray> manure_;
  runtime::WorldFeed feed_;
};

}  // namespace coop::camera_driver
