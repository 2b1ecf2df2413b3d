#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>

namespace eprosima::fastdds::rtps {
struct TransportDescriptorInterface;
}

namespace coop::runtime {

/// Whether the packet may be shown to Fast DDS: an RTPS message whose sub-messages lie within it,
/// one behind the other, are sound (rtps_message.hpp), and whose statistics (a vendor's
/// sub-message, kind 0x80), if any, come last, where Fast DDS puts them. Its version 2.9.1 ends the
/// process by an assertion where they come earlier.
[[nodiscard]] bool is_harmless(std::span<const std::uint8_t> packet);

/// Whether a harmless packet makes a participant known or carries a handshake of DDS Security.
[[nodiscard]] bool introduces(std::span<const std::uint8_t> packet);

/// Whether a harmless packet is protected as one of a participant with keys is (governance of
/// `coop keys`): discovery and liveliness always, and everything but introductions where messages
/// are signed. Fast DDS 2.9.1 protects what it sends and takes in what is not.
[[nodiscard]] bool is_protected(std::span<const std::uint8_t> packet, bool signs_all);

/// How Fast DDS 2.9.1 with security is kept from missing somebody; one for all transports of a
/// participant.
struct Introductions {
  /// Packets that introduce are handled one at a time. Two that come at once, by multicast and by
  /// unicast, are mixed up (SecurityManager::match_builtin_endpoints fills members without a lock),
  /// and one of the two senders is never let in; and a handshake is forgotten that comes while its
  /// sender is being looked at, until it is sent again a second later.
  std::mutex mutex;
  /// Until then the participant does not announce itself: it drops what comes before it is made,
  /// and busy machines answer sooner.
  std::atomic<bool> may_announce = false;
  /// What the participant sends is signed as a whole: so is what its like send.
  std::atomic<bool> signs_all = false;
};

/// A transport that drops packets which are not harmless, come from where their sender does not
/// send (packet_sources.hpp) or, with security, lack protection, before anything else looks at
/// them. Set up `low_level` whole before: its limits are copied here. `introductions`: with
/// security.
[[nodiscard]] std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> low_level,
    std::shared_ptr<Introductions> introductions = nullptr);

}  // namespace coop::runtime
