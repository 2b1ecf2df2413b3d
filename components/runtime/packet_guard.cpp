#include "runtime/packet_guard.hpp"

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <algorithm>
#include <array>
#include <optional>
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
constexpr std::uint8_t kData = 0x15;
constexpr std::uint8_t kStatistics = 0x80;
/// Where a DATA sub-message names its writer, and the two that introduce.
constexpr std::size_t kWriterPlace = 8;
using EntityId = std::array<std::uint8_t, 4>;
constexpr EntityId kAnnouncer{0x00, 0x01, 0x00, 0xc2};
constexpr EntityId kHandshaker{0x00, 0x02, 0x01, 0xc3};

struct Submessage {
  std::uint8_t kind = 0;
  std::span<const std::uint8_t> body;
  bool is_last = false;
};

/// Takes the next off what is left of a packet; nothing where it reaches beyond.
std::optional<Submessage> take_submessage(std::span<const std::uint8_t>& rest) {
  if (rest.size() < kSubmessageHeader) return std::nullopt;
  Submessage next{.kind = rest[0], .body = {}, .is_last = false};
  const bool is_little_endian = (rest[1] & 1U) != 0;
  const unsigned first = rest[2];
  const unsigned second = rest[3];
  std::size_t length = is_little_endian ? first | second << 8U : first << 8U | second;
  rest = rest.subspan(kSubmessageHeader);
  if (length > rest.size()) return std::nullopt;
  // A length of nothing means: to the end, but for the two that may be empty.
  if (length == 0 && next.kind != kPad && next.kind != kInfoTimestamp) length = rest.size();
  next.body = rest.first(length);
  next.is_last = length == rest.size();
  rest = rest.subspan(std::min((length + 3U) & ~std::size_t{3}, rest.size()));
  return next;
}

class GuardedTransport : public rtps::ChainingTransport {
 public:
  struct Descriptor : rtps::ChainingTransportDescriptor {
    using ChainingTransportDescriptor::ChainingTransportDescriptor;
    rtps::TransportInterface* create_transport() const override {
      return new GuardedTransport(*this);  // its caller owns it
    }
    std::shared_ptr<Introductions> introductions;
  };

  explicit GuardedTransport(const Descriptor& descriptor)
      : ChainingTransport(descriptor), descriptor_(descriptor) {}

  rtps::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }

  bool send(SenderResource* sender, const octet* data, std::uint32_t size, LocatorsIterator* begin,
            LocatorsIterator* end, const std::chrono::steady_clock::time_point& timeout) override {
    if (is_silent() && introduces({data, size})) return true;
    return sender->send(data, size, begin, end, timeout);
  }

  void receive(rtps::TransportReceiverInterface* next, const octet* data, std::uint32_t size,
               const Locator_t& local, const Locator_t& remote) override {
    if (!is_harmless({data, size})) return;
    std::unique_lock<std::mutex> alone;
    if (descriptor_.introductions && introduces({data, size})) {
      alone = std::unique_lock(descriptor_.introductions->mutex);
    }
    next->OnDataReceived(data, size, local, remote);
  }

 private:
  [[nodiscard]] bool is_silent() const {
    return descriptor_.introductions && !descriptor_.introductions->may_announce;
  }

  Descriptor descriptor_;
};

}  // namespace

bool is_harmless(std::span<const std::uint8_t> packet) {
  if (packet.size() < kMessageHeader || !std::ranges::equal(packet.first(4), kMagic)) return false;
  for (auto rest = packet.subspan(kMessageHeader); !rest.empty();) {
    const auto next = take_submessage(rest);
    if (!next || (next->kind == kStatistics && !next->is_last)) return false;
  }
  return true;
}

bool introduces(std::span<const std::uint8_t> packet) {
  for (auto rest = packet.subspan(kMessageHeader); !rest.empty();) {
    const auto next = take_submessage(rest);
    if (!next) return false;
    if (next->kind != kData || next->body.size() < kWriterPlace + EntityId().size()) continue;
    const auto writer = next->body.subspan(kWriterPlace, EntityId().size());
    if (std::ranges::equal(writer, kAnnouncer) || std::ranges::equal(writer, kHandshaker)) {
      return true;
    }
  }
  return false;
}

std::shared_ptr<rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<rtps::TransportDescriptorInterface> low_level,
    std::shared_ptr<Introductions> introductions) {
  auto descriptor = std::make_shared<GuardedTransport::Descriptor>(std::move(low_level));
  descriptor->introductions = std::move(introductions);
  return descriptor;
}

}  // namespace coop::runtime
