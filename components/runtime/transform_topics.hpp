#pragma once
#include <optional>
#include <vector>

#include "core/stamped.hpp"
#include "core/transform_buffer.hpp"
#include "runtime/node.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace coop::runtime {

/// Fills a buffer from tf and tf_static.
class TransformListener {
 public:
  TransformListener(Node& node, Duration history);
  [[nodiscard]] const TransformBuffer& buffer() const { return buffer_; }
  void clear() { buffer_.clear_history(); }

 private:
  void receive(Node& node, const tf2_msgs::msg::TFMessage& message, bool is_static);
  TransformBuffer buffer_;
};

/// Writes tf, and tf_static with all static transforms of this component in one latched message.
class TransformPublisher {
 public:
  explicit TransformPublisher(Node& node) : node_(node) {}
  void advertise_moving();
  void publish(const StampedTransform& transform);
  void publish_static(StampedTransform transform);

 private:
  Node& node_;
  std::optional<Publisher<tf2_msgs::msg::TFMessage>> moving_;
  std::optional<Publisher<tf2_msgs::msg::TFMessage>> fixed_;
  std::vector<StampedTransform> fixed_transforms_;
};

}  // namespace coop::runtime
