#pragma once
#include <chrono>
#include <cstdint>
#include <mutex>
#include <shared_mutex>
#include <unordered_map>
#include <vector>

#include "runtime/rtps_message.hpp"

namespace coop::runtime {

/// Whence a packet came: IPv4, in the machine's byte order.
struct PacketSource {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
};

/// UDP ports this process has sockets at.
[[nodiscard]] std::vector<std::uint16_t> own_udp_ports();

/// The packet with a sub-message in front that says from which ports its sender sends, in a form
/// others skip (a vendor's kind).
[[nodiscard]] std::vector<std::uint8_t> with_source_ports(wire::Bytes packet,
                                                          const std::vector<std::uint16_t>& ports);

/// Whence those send who say so. A participant of Coop's runtime tells its ports with each of its
/// announcements; a packet in its name from another port is forged. Who does not tell (other DDS,
/// whoever sits behind a network address translation that changes ports) is believed as ever.
/// Safe to be used from several threads.
class PacketSources {
 public:
  using Wall = std::chrono::steady_clock;

  /// Whether a packet whose sub-messages lie within it may be from whom it says, and from those in
  /// whose name it speaks on or of whom it tells; learns from announcements that may.
  [[nodiscard]] bool may_be_genuine(wire::Bytes packet, PacketSource from);
  /// The participant of this program itself.
  void add_own(const wire::Prefix& name, const std::vector<std::uint16_t>& ports);

 private:
  struct Known {
    std::vector<std::uint16_t> ports;
    /// Heard by the loopback interface: whatever it sends comes from an address of this machine.
    bool is_here = false;
    Wall::time_point told;
  };
  struct Hash {
    std::size_t operator()(const wire::Prefix& prefix) const noexcept;
  };

  [[nodiscard]] bool may_be(const wire::Prefix& name, PacketSource from);
  [[nodiscard]] bool is_own_address(std::uint32_t address);
  void learn(const wire::Prefix& name, std::vector<std::uint16_t> ports, PacketSource from);

  std::shared_mutex mutex_;
  std::unordered_map<wire::Prefix, Known, Hash> known_;
  std::mutex addresses_mutex_;
  std::vector<std::uint32_t> addresses_;
  Wall::time_point addresses_read_;
};

}  // namespace coop::runtime
