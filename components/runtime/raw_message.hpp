#pragma once
#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "runtime/message_type.hpp"

namespace coop::runtime {

/// A topic by its name on the wire (`rt/scan`), for programs that handle topics they do not know.
struct WireTopic {
  std::string name;
  std::string type;  ///< on the wire, "sensor_msgs::msg::dds_::LaserScan_"
  bool keyed = false;

  auto operator<=>(const WireTopic&) const = default;
};

/// Policies of an endpoint. History and depth are not told by discovery and count for endpoints of
/// this program only.
struct WireQos {
  enum class Liveliness : std::uint8_t { kAutomatic, kManualByParticipant, kManualByTopic };

  bool reliable = true;
  bool transient_local = false;
  bool keep_all = true;
  int depth = 1;
  Duration deadline = Duration::max();
  Duration lifespan = Duration::max();
  Liveliness liveliness = Liveliness::kAutomatic;
  Duration liveliness_lease = Duration::max();
  std::vector<std::string> partitions;  ///< of endpoints found; empty: the default partition

  bool operator==(const WireQos&) const = default;
};

/// Identity of a writer or reader; text as in Sample::writer.
struct EndpointId {
  std::array<std::uint8_t, 16> bytes{};

  // clang-tidy 14 takes the 0 of the comparison for a pointer.
  // NOLINTNEXTLINE(modernize-use-nullptr)
  auto operator<=>(const EndpointId&) const = default;
  [[nodiscard]] std::string text() const;
};

/// A sample as on the wire.
struct RawSample {
  std::vector<std::uint8_t> bytes;  ///< CDR, with its encapsulation header of 4 bytes
  EndpointId writer;
  std::uint64_t sequence = 0;  ///< of that writer, from 1
  Time source_time{};          ///< system time at which it was written
  Time reception_time{};       ///< system time at which it arrived
};

/// What raw samples are for the transports: the message is a std::vector<std::uint8_t>, with the
/// encapsulation header. Instances of keyed types are told apart where the type is one of ours; of
/// others every writer has one.
class RawMessageType : public MessageType {
 public:
  RawMessageType(std::string dds_type, bool keyed);

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::shared_ptr<void> create() const override;
  [[nodiscard]] std::shared_ptr<const void> clone(const void* message) const override;
  [[nodiscard]] std::string key_of(const void* message) const override;
  void serialize(const void* message, std::vector<std::uint8_t>& out) const override;
  bool deserialize(const std::vector<std::uint8_t>& bytes, void* message) const override;
  [[nodiscard]] eprosima::fastdds::dds::TopicDataType* new_dds_type() const override;

 private:
  std::string name_;
  bool keyed_;
};

/// Reads a message of ours from the wire; false where the bytes are none.
template <class Message>
[[nodiscard]] bool from_wire(const std::vector<std::uint8_t>& bytes, Message& message) {
  return message_type<Message>().deserialize(bytes, &message);
}

}  // namespace coop::runtime
