#include "camera_driver/node/camera_topics.hpp"

#include <opencv2/core.hpp>

#include "conversions/detections.hpp"
#include "conversions/image.hpp"
#include "conversions/sensors.hpp"
#include "core/robot/robot_model.hpp"

namespace coop::camera_driver {
namespace {

using runtime::Qos;

const std::string kFrameId{robot::kCameraOpticalFrame};

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
  if (info_.has_subscribers()) {
    info_.publish(conversions::to_msg(Stamped<Intrinsics>{frame.stamp, kFrameId, intrinsics}));
  }
}

void CameraTopics::publish(Time stamp, std::vector<Detection> eggs) {
  const bool sent = eggs_.publish(conversions::to_msg({stamp, kFrameId, std::move(eggs)}));
  if (!sent && node_.log().is_due("eggs", seconds(5))) {
    node_.log().warning("a reader of eggs does not keep up");
  }
}

}  // namespace coop::camera_driver
