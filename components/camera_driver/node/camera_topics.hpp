#pragma once
#include <sensor_msgs/msg/CameraInfo.h>
#include <sensor_msgs/msg/Image.h>
#include <vision_msgs/msg/Detection3DArray.h>

#include "camera_driver/frame.hpp"
#include "camera_driver/intrinsics.hpp"
#include "core/detection.hpp"
#include "runtime/node.hpp"

namespace coop::camera_driver {

/// What a camera tells the others. Pictures are made into messages only if somebody listens.
class CameraTopics {
 public:
  explicit CameraTopics(runtime::Node& node);

  void publish(const Frame& frame, const Intrinsics& intrinsics);
  void publish(Time stamp, std::vector<Detection> eggs);

 private:
  runtime::Node& node_;
  runtime::Publisher<sensor_msgs::msg::Image> colour_;
  runtime::Publisher<sensor_msgs::msg::Image> depth_;
  runtime::Publisher<sensor_msgs::msg::CameraInfo> info_;
  runtime::Publisher<vision_msgs::msg::Detection3DArray> eggs_;
};

}  // namespace coop::camera_driver
