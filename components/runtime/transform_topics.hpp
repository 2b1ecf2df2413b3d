#pragma once
#include "core/transform_buffer.hpp"
#include "runtime/node.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace coop::runtime {

/// Fills a buffer from tf and tf_static.
class TransformListener {
 public:
  explicit TransformListener(Node& node);
  [[nodiscard]] const TransformBuffer& buffer() const { return buffer_; }
  void clear() { buffer_.clear_history(); }

 private:
  void receive(Node& node, const tf2_msgs::msg::TFMessage& message, bool is_static);
  TransformBuffer buffer_;
};

/// Writes tf, and tf_static with all static transforms of this component in one latched message.
class TransformPublisher {
 public:
  explicit TransformPublisher(Node& node);
  void publish(std::string_view parent, std::string_view child, Time stamp, const Pose3& pose);
  void publish_static(std::string_view parent, std::string_view child, Time stamp,
                      const Pose3& pose);

 private:
  Publisher<tf2_msgs::msg::TFMessage> moving_;
  Publisher<tf2_msgs::msg::TFMessage> fixed_;
  tf2_msgs::msg::TFMessage fixed_message_;
};

}  // namespace coop::runtime
