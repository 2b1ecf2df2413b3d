#include "runtime/transform_topics.hpp"

#include <span>

#include "conversions/geometry.hpp"

namespace coop::runtime {

TransformListener::TransformListener(Node& node, Duration history) : buffer_(history) {
  node.subscribe<tf2_msgs::msg::TFMessage>(
      "tf_static", Qos::kStateLatched,
      [this, &node](const tf2_msgs::msg::TFMessage& message) { receive(node, message, true); },
      Attention::kPatient);
  node.subscribe<tf2_msgs::msg::TFMessage>(
      "tf", Qos::kEvent,
      [this, &node](const tf2_msgs::msg::TFMessage& message) { receive(node, message, false); },
      Attention::kPatient);
}

void TransformListener::receive(Node& node, const tf2_msgs::msg::TFMessage& message,
                                bool is_static) {
  for (const auto& transform_message : message.transforms()) {
    const auto transform = conversions::from_msg(transform_message);
    if (!transform) {
      if (node.log().is_due("bad transform", std::chrono::seconds(5))) {
        node.log().warning("transform {} -> {} ignored: {}", transform_message.header().frame_id(),
                           transform_message.child_frame_id(), transform.error());
      }
      continue;
    }
    if (is_static) {
      buffer_.insert_static(transform->parent, transform->child, transform->child_in_parent);
    } else {
      buffer_.insert(transform->parent, transform->child, transform->stamp,
                     transform->child_in_parent);
    }
  }
}

// Each writer is made when it is needed: permissions may hold for one of the topics only.
void TransformPublisher::advertise_moving() {
  if (!moving_) moving_ = node_.advertise<tf2_msgs::msg::TFMessage>("tf", Qos::kEvent);
}

void TransformPublisher::publish(const StampedTransform& transform) {
  advertise_moving();
  moving_->publish(conversions::to_msg(std::span(&transform, 1)));
}

void TransformPublisher::publish_static(StampedTransform transform) {
  if (!fixed_) fixed_ = node_.advertise<tf2_msgs::msg::TFMessage>("tf_static", Qos::kStateLatched);
  std::erase_if(fixed_transforms_,
                [&](const StampedTransform& known) { return known.child == transform.child; });
  fixed_transforms_.push_back(std::move(transform));
  fixed_->publish(conversions::to_msg(fixed_transforms_));
}

}  // namespace coop::runtime
