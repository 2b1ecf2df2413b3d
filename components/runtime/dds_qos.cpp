#include "runtime/dds_qos.hpp"

namespace coop::runtime {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::Duration_t;

namespace {

constexpr int kStreamDepth = 5;
constexpr int kEventDepth = 2000;
/// Writers of one latched topic at a time, such as tf_static.
constexpr int kLatchedWriters = 16;

/// What writers and readers of an intent share.
template <class EndpointQos>
void apply_common(Qos intent, const DdsOptions& options, EndpointQos& qos) {
  const bool is_stream = intent == Qos::kSensorStream;
  const bool is_latched = intent == Qos::kStateLatched || intent == Qos::kHeartbeat;
  const bool must_arrive = !is_stream || options.reliable_streams || options.complete;
  const bool keeps_all = intent == Qos::kEvent || (is_stream && must_arrive) ||
                         (intent == Qos::kCommand && options.complete);
  qos.reliability().kind =
      !must_arrive ? dds::BEST_EFFORT_RELIABILITY_QOS : dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind =
      is_latched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = keeps_all ? dds::KEEP_ALL_HISTORY_QOS : dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = is_stream ? kStreamDepth : 1;
  qos.resource_limits().max_samples = keeps_all ? kEventDepth : 500;
  qos.resource_limits().max_instances = 100;
  qos.resource_limits().max_samples_per_instance = keeps_all ? kEventDepth : kStreamDepth;
  qos.resource_limits().allocated_samples = 0;
  qos.data_sharing().off();
  if (intent == Qos::kHeartbeat) {
    // AUTOMATIC never fires while another automatic writer lives in the domain (Fast DDS 2.9).
    qos.liveliness().kind = dds::MANUAL_BY_TOPIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = Duration_t(1, 0);
  }
}

}  // namespace

void apply_intent(Qos intent, const DdsOptions& options, dds::DataWriterQos& qos) {
  apply_common(intent, options, qos);
  // Streams that must be complete slow their writer down; a stalled reader is dropped with its
  // participant's lease.
  qos.reliability().max_blocking_time = intent == Qos::kSensorStream || options.complete
                                            ? Duration_t(10, 0)
                                            : Duration_t(0, 200'000'000);
  // Only offered, never requested: a ROS 2 publisher without a deadline may drive the robot too.
  if (intent == Qos::kCommand) qos.deadline().period = Duration_t(0, 200'000'000);
  if (intent == Qos::kHeartbeat) {
    qos.liveliness().announcement_period = Duration_t(0, 500'000'000);
  }
  qos.reliable_writer_qos().times.heartbeatPeriod = Duration_t(0, 100'000'000);
}

void apply_intent(Qos intent, const DdsOptions& options, dds::DataReaderQos& qos) {
  apply_common(intent, options, qos);
  // A reader's history counts the samples of all writers together: with a depth of 1, the last word
  // of one writer would push out that of another before it is taken.
  if (intent == Qos::kStateLatched) {
    qos.history().depth = kLatchedWriters;
    qos.resource_limits().max_samples_per_instance = kLatchedWriters;
    qos.resource_limits().max_samples = kLatchedWriters * qos.resource_limits().max_instances;
  }
}

}  // namespace coop::runtime
