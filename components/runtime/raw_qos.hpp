#pragma once
#include <fastrtps/qos/ReaderQos.h>
#include <fastrtps/qos/WriterQos.h>

#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "runtime/raw_message.hpp"

namespace coop::runtime {

/// Policies of single endpoints, without intents, to and from Fast DDS.
[[nodiscard]] WireQos wire_qos_of(const eprosima::fastdds::dds::WriterQos& qos);
[[nodiscard]] WireQos wire_qos_of(const eprosima::fastdds::dds::ReaderQos& qos);
void apply(const WireQos& wanted, eprosima::fastdds::dds::DataWriterQos& qos);
void apply(const WireQos& wanted, eprosima::fastdds::dds::DataReaderQos& qos);

[[nodiscard]] Duration from_dds(const eprosima::fastrtps::Duration_t& duration);
[[nodiscard]] eprosima::fastrtps::Duration_t to_dds(Duration duration);

}  // namespace coop::runtime
