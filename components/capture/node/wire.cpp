#include "capture/node/wire.hpp"

#include <fnmatch.h>

#include <algorithm>

#include "capture/traffic/topic_names.hpp"

namespace coop::capture {

runtime::DdsOptions raw_options(const runtime::Options& options) {
  return {.domain = options.domain,
          .participant_name = options.name,
          .partition = options.robot,
          .settings = runtime::read_dds_settings(options.dds),
          .sees_all_topics = true};
}

OfferedQos offered_qos(const runtime::WireQos& qos) {
  OfferedQos offered;
  offered.reliable = qos.reliable;
  offered.transient_local = qos.transient_local;
  offered.deadline = qos.deadline;
  offered.lifespan = qos.lifespan;
  offered.liveliness = qos.liveliness == runtime::WireQos::Liveliness::kManualByTopic
                           ? OfferedQos::Liveliness::kManualByTopic
                           : OfferedQos::Liveliness::kAutomatic;
  offered.liveliness_lease = qos.liveliness_lease;
  return offered;
}

runtime::WireQos wire_qos(const OfferedQos& qos) {
  runtime::WireQos wire;
  wire.reliable = qos.reliable;
  wire.transient_local = qos.transient_local;
  wire.keep_all = qos.history == OfferedQos::History::kKeepAll ||
                  (qos.history == OfferedQos::History::kUnknown && !qos.transient_local);
  wire.depth = std::max(qos.depth, 1);
  // Deadlines and liveliness were promises of the program recorded; a replay may pause.
  return wire;
}

WriterInfo writer_info(const runtime::DiscoveredEndpoint& endpoint) {
  return {.topic = shown_topic(endpoint.topic.name),
          .dds_type = endpoint.topic.type,
          .keyed = endpoint.topic.keyed,
          .qos = offered_qos(endpoint.qos),
          .component = endpoint.participant,
          .id = endpoint.id.text()};
}

bool same_partition(const std::string& own, const std::vector<std::string>& others) {
  const auto matches_own = [&own](const std::string& other) {
    return own == other || ::fnmatch(own.c_str(), other.c_str(), 0) == 0 ||
           ::fnmatch(other.c_str(), own.c_str(), 0) == 0;
  };
  return others.empty() ? matches_own("") : std::ranges::any_of(others, matches_own);
}

}  // namespace coop::capture
