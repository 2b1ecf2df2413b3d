#include "camera_driver/node/overhead_backend.hpp"

#include "camera_driver/node/camera_driver_node.hpp"
#include "conversions/detections.hpp"
#include "conversions/image.hpp"
#include "conversions/sensors.hpp"

namespace coop::camera_driver {
namespace {

using runtime::Qos;

const std::string kPictureFrame{kOverheadOpticalFrame};

}  // namespace

OverheadBackend::OverheadBackend(runtime::Node& node, const CameraDriverConfig& config,
                                 const RobotBody& robot)
    : mount_(config.overhead.mount),
      detector_(config.overhead.detector, mount_),
      picture_(node.advertise<sensor_msgs::msg::Image>("camera/image", Qos::kSensorStream)),
      info_(node.advertise<sensor_msgs::msg::CameraInfo>("camera/camera_info", Qos::kSensorStream)),
      animals_(node.advertise<vision_msgs::msg::Detection3DArray>("animals", Qos::kEvent)),
      manure_(node.advertise<vision_msgs::msg::Detection3DArray>("manure", Qos::kEvent)),
      feed_(node, config.overhead.rate,
            {.world =
                 [this, robot, &node, noise = config.overhead.noise](const world::World& world) {
                   camera_.emplace(mount_, noise, world, robot, node.options().seed);
                 },
             .measure = [this](const world::GroundTruth& truth) { measure(truth); }}) {
  node.publish_static_transform("map", kOverheadOpticalFrame, mount_.camera_in_map());
}

void OverheadBackend::measure(const world::GroundTruth& truth) {
  camera_->take(truth, frame_);
  publish_picture();
  PenSighting seen = detector_.detect(frame_.colour);
  animals_.publish(conversions::to_msg(
      Stamped<std::vector<Detection>>{frame_.stamp, "map", std::move(seen.pigs)}));
  manure_.publish(conversions::to_msg(
      Stamped<std::vector<Detection>>{frame_.stamp, "map", std::move(seen.heaps)}));
}

void OverheadBackend::publish_picture() {
  if (picture_.has_subscribers()) {
    const auto message = conversions::to_msg({frame_.stamp, kPictureFrame, "rgb8", frame_.colour});
    if (message) picture_.publish(*message);
  }
  if (info_.has_subscribers()) {
    info_.publish(
        conversions::to_msg(Stamped<Intrinsics>{frame_.stamp, kPictureFrame, mount_.intrinsics()}));
  }
}

}  // namespace coop::camera_driver
