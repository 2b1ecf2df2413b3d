#include "runtime/packet_guard.hpp"

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <utility>

#include "runtime/rtps_message.hpp"

namespace coop::runtime {
namespace {

namespace rtps = eprosima::fastdds::rtps;
using namespace coop::runtime::wire;  // NOLINT(google-build-using-namespace)
using eprosima::fastrtps::rtps::Locator_t;
using eprosima::fastrtps::rtps::LocatorsIterator;
using eprosima::fastrtps::rtps::octet;
using eprosima::fastrtps::rtps::PropertyPolicy;
using eprosima::fastrtps::rtps::SenderResource;

/// The two that introduce.
constexpr EntityId kAnnouncer{0x00, 0x01, 0x00, 0xc2};
constexpr EntityId kHandshaker{0x00, 0x02, 0x01, 0xc3};

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
  if (!has_header(packet)) return false;
  for (auto rest = packet.subspan(kHeader); !rest.empty();) {
    const auto next = take_submessage(rest);
    if (!next || (next->kind == kStatistics && !next->is_last) || !is_sound(*next)) return false;
  }
  return true;
}

bool introduces(std::span<const std::uint8_t> packet) {
  for (auto rest = packet.subspan(kHeader); !rest.empty();) {
    const auto next = take_submessage(rest);
    if (!next) return false;
    if (next->kind != kData) continue;
    const auto writer = next->writer();
    if (writer == kAnnouncer || writer == kHandshaker) return true;
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
