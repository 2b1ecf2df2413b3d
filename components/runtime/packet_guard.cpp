#include "runtime/packet_guard.hpp"

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <algorithm>
#include <array>
#include <utility>

namespace coop::runtime {
namespace {

namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::Locator_t;
using eprosima::fastrtps::rtps::LocatorsIterator;
using eprosima::fastrtps::rtps::octet;
using eprosima::fastrtps::rtps::PropertyPolicy;
using eprosima::fastrtps::rtps::SenderResource;

constexpr std::array<std::uint8_t, 4> kMagic{'R', 'T', 'P', 'S'};
constexpr std::size_t kMessageHeader = 20;
constexpr std::size_t kSubmessageHeader = 4;
constexpr std::uint8_t kPad = 0x01;
constexpr std::uint8_t kInfoTimestamp = 0x09;
constexpr std::uint8_t kStatistics = 0x80;

class GuardedTransport : public rtps::ChainingTransport {
 public:
  explicit GuardedTransport(const rtps::ChainingTransportDescriptor& descriptor)
      : ChainingTransport(descriptor), descriptor_(descriptor) {}

  rtps::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }

  bool send(SenderResource* sender, const octet* data, std::uint32_t size, LocatorsIterator* begin,
            LocatorsIterator* end, const std::chrono::steady_clock::time_point& timeout) override {
    return sender->send(data, size, begin, end, timeout);
  }

  void receive(rtps::TransportReceiverInterface* next, const octet* data, std::uint32_t size,
               const Locator_t& local, const Locator_t& remote) override {
    if (is_harmless({data, size})) next->OnDataReceived(data, size, local, remote);
  }

 private:
  struct Descriptor : rtps::ChainingTransportDescriptor {
    using ChainingTransportDescriptor::ChainingTransportDescriptor;
    explicit Descriptor(const ChainingTransportDescriptor& other)
        : ChainingTransportDescriptor(other) {}
    rtps::TransportInterface* create_transport() const override {
      return new GuardedTransport(*this);  // its caller owns it
    }
  };
  friend std::shared_ptr<rtps::TransportDescriptorInterface> coop::runtime::guarded(
      std::shared_ptr<rtps::TransportDescriptorInterface> low_level);

  Descriptor descriptor_;
};

}  // namespace

bool is_harmless(std::span<const std::uint8_t> packet) {
  if (packet.size() < kMessageHeader || !std::ranges::equal(packet.first(4), kMagic)) return false;
  std::size_t at = kMessageHeader;
  while (at < packet.size()) {
    if (packet.size() - at < kSubmessageHeader) return false;
    const std::uint8_t kind = packet[at];
    const bool is_little_endian = (packet[at + 1] & 1U) != 0;
    const unsigned first = packet[at + 2];
    const unsigned second = packet[at + 3];
    std::size_t length = is_little_endian ? first | second << 8U : first << 8U | second;
    at += kSubmessageHeader;
    const std::size_t rest = packet.size() - at;
    if (length > rest) return false;
    // A length of nothing means: to the end, but for the two that may be empty.
    if (length == 0 && kind != kPad && kind != kInfoTimestamp) length = rest;
    if (kind == kStatistics && length != rest) return false;
    at += std::min((length + 3U) & ~std::size_t{3}, rest);
  }
  return true;
}

std::shared_ptr<rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<rtps::TransportDescriptorInterface> low_level) {
  return std::make_shared<GuardedTransport::Descriptor>(std::move(low_level));
}

}  // namespace coop::runtime
