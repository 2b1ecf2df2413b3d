#pragma once
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "runtime/dds_transport.hpp"

namespace coop::runtime {

/// The one place where intents become DDS policies.
[[nodiscard]] eprosima::fastdds::dds::DomainParticipantQos participant_qos(
    eprosima::fastdds::dds::DomainParticipantQos base, const DdsOptions& options);
void apply_intent(Qos intent, const DdsOptions& options,
                  eprosima::fastdds::dds::DataWriterQos& qos);
void apply_intent(Qos intent, const DdsOptions& options,
                  eprosima::fastdds::dds::DataReaderQos& qos);

}  // namespace coop::runtime
