#pragma once
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "runtime/dds_transport.hpp"

namespace coop::runtime {

/// The one place where intents become DDS policies.
void apply_intent(Qos intent, const DdsOptions& options,
                  eprosima::fastdds::dds::DataWriterQos& qos);
void apply_intent(Qos intent, const DdsOptions& options,
                  eprosima::fastdds::dds::DataReaderQos& qos);

}  // namespace coop::runtime
