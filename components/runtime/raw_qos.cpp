#include "runtime/raw_qos.hpp"

namespace coop::runtime {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::c_TimeInfinite;
using eprosima::fastrtps::Duration_t;

namespace {

/// What readers and writers tell alike.
template <class DdsQos>
WireQos common_of(const DdsQos& qos) {
  WireQos out;
  out.reliable = qos.m_reliability.kind == dds::RELIABLE_RELIABILITY_QOS;
  out.transient_local = qos.m_durability.kind >= dds::TRANSIENT_LOCAL_DURABILITY_QOS;
  out.deadline = from_dds(qos.m_deadline.period);
  out.lifespan = from_dds(qos.m_lifespan.duration);
  out.liveliness = static_cast<WireQos::Liveliness>(qos.m_liveliness.kind);
  out.liveliness_lease = from_dds(qos.m_liveliness.lease_duration);
  for (const auto& name : qos.m_partition.getNames()) out.partitions.push_back(name);
  return out;
}

/// `limits`: samples kept; 0: no limit.
template <class DdsQos>
void apply_common(const WireQos& wanted, DdsQos& qos) {
  qos.reliability().kind =
      wanted.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind =
      wanted.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = wanted.keep_all ? dds::KEEP_ALL_HISTORY_QOS : dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = wanted.depth;
  qos.resource_limits().max_samples = 0;
  qos.resource_limits().max_instances = 0;
  qos.resource_limits().max_samples_per_instance = 0;
  qos.resource_limits().allocated_samples = 0;
  qos.data_sharing().off();
}

}  // namespace

Duration from_dds(const Duration_t& duration) {
  if (duration == c_TimeInfinite) return Duration::max();
  return std::chrono::seconds(duration.seconds) + std::chrono::nanoseconds(duration.nanosec);
}

Duration_t to_dds(Duration duration) {
  if (duration == Duration::max()) return c_TimeInfinite;
  const auto nanoseconds = duration.count();
  return {static_cast<std::int32_t>(nanoseconds / 1'000'000'000),
          static_cast<std::uint32_t>(nanoseconds % 1'000'000'000)};
}

WireQos wire_qos_of(const dds::WriterQos& qos) {
  return common_of(qos);
}

WireQos wire_qos_of(const dds::ReaderQos& qos) {
  return common_of(qos);
}

void apply(const WireQos& wanted, dds::DataWriterQos& qos) {
  apply_common(wanted, qos);
  // Bounded: a reader that does not take its samples must not fill the memory.
  constexpr int kMostKept = 5000;
  if (wanted.keep_all) qos.resource_limits().max_samples_per_instance = kMostKept;
  qos.deadline().period = to_dds(wanted.deadline);
  qos.lifespan().duration = to_dds(wanted.lifespan);
  qos.reliability().max_blocking_time = Duration_t(0, 200'000'000);
  qos.reliable_writer_qos().times.heartbeatPeriod = Duration_t(0, 100'000'000);
  qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
}

void apply(const WireQos& wanted, dds::DataReaderQos& qos) {
  apply_common(wanted, qos);
}

}  // namespace coop::runtime
