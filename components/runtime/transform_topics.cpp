#include "runtime/transform_topics.hpp"

#include <algorithm>

#include "conversions/geometry.hpp"
#include "conversions/time.hpp"

namespace coop::runtime {

using geometry_msgs::msg::TransformStamped;

TransformListener::TransformListener(Node& node) {
  node.subscribe<tf2_msgs::msg::TFMessage>(
      "tf_static", Qos::kStateLatched,
      [this, &node](const tf2_msgs::msg::TFMessage& message) { receive(node, message, true); });
  node.subscribe<tf2_msgs::msg::TFMessage>(
      "tf", Qos::kEvent,
      [this, &node](const tf2_msgs::msg::TFMessage& message) { receive(node, message, false); });
}

void TransformListener::receive(Node& node, const tf2_msgs::msg::TFMessage& message,
                                bool is_static) {
  for (const TransformStamped& transform : message.transforms()) {
    const auto pose = conversions::from_msg(transform.transform());
    if (!pose) {
      if (node.log().is_due("bad transform", std::chrono::seconds(5))) {
        node.log().warning("transform {} -> {} ignored: {}", transform.header().frame_id(),
                           transform.child_frame_id(), pose.error());
      }
      continue;
    }
    const std::string& parent = transform.header().frame_id();
    if (is_static) {
      buffer_.insert_static(parent, transform.child_frame_id(), *pose);
    } else {
      buffer_.insert(parent, transform.child_frame_id(),
                     conversions::from_msg(transform.header().stamp()), *pose);
    }
  }
}

namespace {

TransformStamped to_message(std::string_view parent, std::string_view child, Time stamp,
                            const Pose3& pose) {
  TransformStamped message;
  message.header().frame_id(std::string(parent));
  message.header().stamp(conversions::to_msg(stamp));
  message.child_frame_id(std::string(child));
  message.transform(conversions::to_transform_msg(pose));
  return message;
}

}  // namespace

TransformPublisher::TransformPublisher(Node& node)
    : moving_(node.advertise<tf2_msgs::msg::TFMessage>("tf", Qos::kEvent)),
      fixed_(node.advertise<tf2_msgs::msg::TFMessage>("tf_static", Qos::kStateLatched)) {}

void TransformPublisher::publish(std::string_view parent, std::string_view child, Time stamp,
                                 const Pose3& pose) {
  tf2_msgs::msg::TFMessage message;
  message.transforms().push_back(to_message(parent, child, stamp, pose));
  moving_.publish(message);
}

void TransformPublisher::publish_static(std::string_view parent, std::string_view child, Time stamp,
                                        const Pose3& pose) {
  auto& transforms = fixed_message_.transforms();
  std::erase_if(transforms, [&](const auto& known) { return known.child_frame_id() == child; });
  transforms.push_back(to_message(parent, child, stamp, pose));
  fixed_.publish(fixed_message_);
}

}  // namespace coop::runtime
