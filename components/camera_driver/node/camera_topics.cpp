#include "camera_driver/node/camera_topics.hpp"

#include <opencv2/core.hpp>

#include "conversions/detections.hpp"
#include "conversions/image.hpp"
#include "conversions/time.hpp"
#include "core/robot/robot_model.hpp"

namespace coop::camera_driver {
namespace {

using runtime::Qos;

const std::string kFrameId{robot::kCameraOpticalFrame};

sensor_msgs::msg::CameraInfo to_info(const Intrinsics& camera, Time stamp) {
  sensor_msgs::msg::CameraInfo info;
  info.header(conversions::to_header(stamp, kFrameId));
  info.width(static_cast<std::uint32_t>(camera.width));
  info.height(static_cast<std::uint32_t>(camera.height));
  info.distortion_model("plumb_bob");
  info.d().assign(5, 0.0);
  info.k({camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0});
  info.r({1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  info.p({camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0});
  return info;
}

}  // namespace

CameraTopics::CameraTopics(runtime::Node& node)
    : node_(node),
      colour_(node.advertise<sensor_msgs::msg::Image>("camera/image", Qos::kSensorStream)),
      depth_(node.advertise<sensor_msgs::msg::Image>("camera/depth", Qos::kSensorStream)),
      info_(node.advertise<sensor_msgs::msg::CameraInfo>("camera/camera_info", Qos::kSensorStream)),
      eggs_(node.advertise<vision_msgs::msg::Detection3DArray>("eggs", Qos::kEvent)) {}

void CameraTopics::publish(const Frame& frame, const Intrinsics& intrinsics) {
  if (colour_.has_subscribers()) {
    const auto message = conversions::to_msg({frame.stamp, kFrameId, "rgb8", frame.colour});
    if (message) colour_.publish(*message);
  }
  if (!frame.depth.empty() && depth_.has_subscribers()) {
    const auto message = conversions::to_msg({frame.stamp, kFrameId, "16UC1", frame.depth});
    if (message) depth_.publish(*message);
  }
  if (info_.has_subscribers()) info_.publish(to_info(intrinsics, frame.stamp));
}

void CameraTopics::publish(Time stamp, std::vector<Detection> eggs) {
  const bool sent = eggs_.publish(conversions::to_msg({stamp, kFrameId, std::move(eggs)}));
  if (!sent && node_.log().is_due("eggs", seconds(5))) {
    node_.log().warning("a reader of eggs does not keep up");
  }
}

}  // namespace coop::camera_driver
