#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace eprosima::fastdds::dds {
class TopicDataType;
}

namespace coop::runtime {

/// What the transports must know of an IDL type. One static instance a type; message_type<M>()
/// names it.
class MessageType {
 public:
  virtual ~MessageType() = default;
  /// On the wire, e.g. sensor_msgs::msg::dds_::LaserScan_
  [[nodiscard]] virtual const std::string& name() const = 0;
  [[nodiscard]] virtual std::shared_ptr<void> create() const = 0;
  [[nodiscard]] virtual std::shared_ptr<const void> clone(const void* message) const = 0;
  /// Text that tells the instances of a keyed type apart, empty for types without key.
  [[nodiscard]] virtual std::string key_of(const void* message) const = 0;
  /// The message as on the wire (CDR with its encapsulation header); padding is zero.
  virtual void serialize(const void* message, std::vector<std::uint8_t>& out) const = 0;
  /// The other way; false where the bytes are no such message.
  virtual bool deserialize(const std::vector<std::uint8_t>& bytes, void* message) const = 0;
  /// A new Fast DDS type support, owned by the caller.
  [[nodiscard]] virtual eprosima::fastdds::dds::TopicDataType* new_dds_type() const = 0;
};

/// Defined for the message types listed in idl/CMakeLists.txt (COOP_IDL_MESSAGES).
template <class Message>
[[nodiscard]] const MessageType& message_type();

/// By its name on the wire; null for a type that is none of ours.
[[nodiscard]] const MessageType* find_message_type(std::string_view dds_type);

}  // namespace coop::runtime
