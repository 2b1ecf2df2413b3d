#pragma once
#include <cstdint>
#include <memory>
#include <span>

namespace eprosima::fastdds::rtps {
struct TransportDescriptorInterface;
}

namespace coop::runtime {

/// Whether the packet may be shown to Fast DDS: an RTPS message whose sub-messages lie within it,
/// one behind the other, and whose statistics (a vendor's sub-message, kind 0x80), if any, come
/// last, where Fast DDS puts them. Its version 2.9.1 ends the process by an assertion where they
/// come earlier.
[[nodiscard]] bool is_harmless(std::span<const std::uint8_t> packet);

/// A transport that drops packets which are not harmless before anything else looks at them. Set up
/// `low_level` whole before: its limits are copied here.
[[nodiscard]] std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> low_level);

}  // namespace coop::runtime
