#include "runtime/packet_guard.hpp"

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "runtime/packet_sources.hpp"
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

/// Of endpoints that DDS Security makes for itself; what they say is always encrypted.
constexpr std::uint8_t kSecret = 0xff;
/// Discovery and liveliness without keys: with keys, nobody has anything to say there.
constexpr std::array<EntityId, 3> kOpenTellers{EntityId{0x00, 0x00, 0x03, 0xc2},
                                               EntityId{0x00, 0x00, 0x04, 0xc2},
                                               EntityId{0x00, 0x02, 0x00, 0xc2}};

bool is_data(const Submessage& submessage) {
  return submessage.kind == kData || submessage.kind == kDataFrag;
}

bool begins_with(std::span<const std::uint8_t> packet, std::uint8_t kind) {
  return packet.size() > kHeader && packet[kHeader] == kind;
}

bool announces(std::span<const std::uint8_t> packet) {
  for (auto rest = packet.subspan(kHeader); !rest.empty();) {
    const auto next = take_submessage(rest);
    if (!next) return false;
    if (next->kind == kData && next->writer() == kAnnouncer) return true;
  }
  return false;
}

PacketSource source_of(const Locator_t& locator) {
  PacketSource source{.address = 0, .port = static_cast<std::uint16_t>(locator.port)};
  for (std::size_t i = 12; i < 16; ++i) source.address = source.address << 8U | locator.address[i];
  return source;
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
    const std::span<const std::uint8_t> packet(data, size);
    if (is_silent() && introduces(packet)) return true;
    if (has_header(packet)) {
      if (descriptor_.introductions && begins_with(packet, kSecureMessage)) {
        descriptor_.introductions->signs_all = true;
      }
      if (announces(packet)) return send_with_ports(sender, packet, begin, end, timeout);
    }
    return sender->send(data, size, begin, end, timeout);
  }

  /// Sockets to send from are opened here and nowhere else; nearly always all of them the first
  /// time of many.
  bool OpenOutputChannel(rtps::SendResourceList& senders, const Locator_t& locator) override {
    const std::scoped_lock lock(ports_mutex_);
    const bool is_first = ports_.empty() && IsLocatorSupported(locator);
    const auto before = is_first ? own_udp_ports() : std::vector<std::uint16_t>();
    const std::size_t count = senders.size();
    const bool is_open = ChainingTransport::OpenOutputChannel(senders, locator);
    if (senders.size() != count) {
      ports_.clear();  // where it is not the first time, others of this process are told with them
      std::ranges::set_difference(own_udp_ports(), before, std::back_inserter(ports_));
    }
    return is_open;
  }

  void receive(rtps::TransportReceiverInterface* next, const octet* data, std::uint32_t size,
               const Locator_t& local, const Locator_t& remote) override {
    const std::span<const std::uint8_t> packet(data, size);
    if (!is_harmless(packet)) return;
    if (remote.kind == LOCATOR_KIND_UDPv4 && !sources_.may_be_genuine(packet, source_of(remote))) {
      return;
    }
    if (descriptor_.introductions && !is_protected(packet, descriptor_.introductions->signs_all)) {
      return;
    }
    std::unique_lock<std::mutex> alone;
    if (descriptor_.introductions && introduces(packet)) {
      alone = std::unique_lock(descriptor_.introductions->mutex);
    }
    next->OnDataReceived(data, size, local, remote);
  }

 private:
  [[nodiscard]] bool is_silent() const {
    return descriptor_.introductions && !descriptor_.introductions->may_announce;
  }

  bool send_with_ports(SenderResource* sender, std::span<const std::uint8_t> packet,
                       LocatorsIterator* begin, LocatorsIterator* end,
                       const std::chrono::steady_clock::time_point& timeout) {
    std::vector<std::uint16_t> ports;
    {
      const std::scoped_lock lock(ports_mutex_);
      ports = ports_;
    }
    if (ports.empty()) {
      return sender->send(packet.data(), static_cast<std::uint32_t>(packet.size()), begin, end,
                          timeout);
    }
    sources_.add_own(wire::sender(packet), ports);
    const auto told = with_source_ports(packet, ports);
    return sender->send(told.data(), static_cast<std::uint32_t>(told.size()), begin, end, timeout);
  }

  Descriptor descriptor_;
  PacketSources sources_;
  std::mutex ports_mutex_;
  std::vector<std::uint16_t> ports_;  ///< from which it sends
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

bool is_protected(std::span<const std::uint8_t> packet, bool signs_all) {
  if (begins_with(packet, kSecureMessage)) return true;
  bool is_inside = false;  // of what is protected on its own
  for (auto rest = packet.subspan(kHeader); !rest.empty();) {
    const auto next = take_submessage(rest);
    if (!next) return false;
    if (next->kind == kSecurePrefix) is_inside = true;
    if (next->kind == kSecurePostfix) is_inside = false;
    const auto writer = next->writer();
    const auto reader = next->reader();
    if (is_inside || !writer || !reader) continue;
    if (is_data(*next) && (writer == kAnnouncer || writer == kHandshaker)) continue;
    if (signs_all || (*writer)[0] == kSecret || (*reader)[0] == kSecret) return false;
    if (is_data(*next) && std::ranges::find(kOpenTellers, *writer) != kOpenTellers.end()) {
      return false;
    }
  }
  return true;
}

std::shared_ptr<rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<rtps::TransportDescriptorInterface> low_level,
    std::shared_ptr<Introductions> introductions) {
  auto descriptor = std::make_shared<GuardedTransport::Descriptor>(std::move(low_level));
  descriptor->introductions = std::move(introductions);
  return descriptor;
}

}  // namespace coop::runtime
