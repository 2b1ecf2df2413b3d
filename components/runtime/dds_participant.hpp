#pragma once
#include <chrono>
#include <fastdds/dds/core/status/StatusMask.hpp>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "runtime/dds_transport.hpp"

namespace eprosima::fastdds::dds {
class DomainParticipant;
class DomainParticipantListener;
}  // namespace eprosima::fastdds::dds

namespace coop::runtime {

struct Introductions;

/// How long somebody who is not heard is remembered.
[[nodiscard]] std::chrono::seconds lease(const DdsSettings& settings);

/// Every participant shows a sign of life more often.
inline constexpr std::chrono::seconds kSignOfLife{1};
/// Who stood still for longer may have been forgotten by others: the lease counts from the last
/// sign of life.
[[nodiscard]] std::chrono::milliseconds forgotten_after(const DdsSettings& settings);
/// Since the beginning of a pause, until the leases that it broke have run out everywhere. Who
/// leaves the domain while one runs out kills others: Fast DDS 2.9.1 ends by an assertion
/// (PDP::check_remote_participant_liveliness).
[[nodiscard]] std::chrono::milliseconds run_out_after(const DdsSettings& settings);

/// The one place where settings become a participant: transports, discovery, lease, security.
/// Throws config::Error for an interface or host that is not there.
[[nodiscard]] eprosima::fastdds::dds::DomainParticipantQos participant_qos(
    eprosima::fastdds::dds::DomainParticipantQos base, const DdsOptions& options,
    const std::shared_ptr<Introductions>& introductions = nullptr);

/// A participant of that description, to be deleted through the factory; with security, one that
/// misses nobody (packet_guard.hpp). Throws std::runtime_error where none can be made.
[[nodiscard]] eprosima::fastdds::dds::DomainParticipant* create_participant(
    const DdsOptions& options,
    eprosima::fastdds::dds::DomainParticipantListener* listener = nullptr);

}  // namespace coop::runtime
