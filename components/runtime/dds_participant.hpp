#pragma once
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "runtime/dds_transport.hpp"

namespace coop::runtime {

/// The one place where settings become a participant: transports, discovery, lease, security.
/// Throws config::Error for an interface or host that is not there.
[[nodiscard]] eprosima::fastdds::dds::DomainParticipantQos participant_qos(
    eprosima::fastdds::dds::DomainParticipantQos base, const DdsOptions& options);

}  // namespace coop::runtime
