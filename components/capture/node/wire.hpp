#pragma once
#include <string>
#include <vector>

#include "capture/traffic/offered_qos.hpp"
#include "capture/traffic/recording.hpp"
#include "runtime/options.hpp"
#include "runtime/raw_participant.hpp"

namespace coop::capture {

/// For a raw participant beside a component's own.
[[nodiscard]] runtime::DdsOptions raw_options(const runtime::Options& options);

/// Between what discovery tells and what captures keep.
[[nodiscard]] OfferedQos offered_qos(const runtime::WireQos& qos);
/// For a writer that plays what was offered so. What the capture does not tell of the history: a
/// latched topic keeps its last sample, others everything.
[[nodiscard]] runtime::WireQos wire_qos(const OfferedQos& qos);

[[nodiscard]] WriterInfo writer_info(const runtime::DiscoveredEndpoint& endpoint);

/// Whether endpoints of a program with this partition (empty: the default one) are matched with an
/// endpoint of those. Either side may have wildcards.
[[nodiscard]] bool same_partition(const std::string& own, const std::vector<std::string>& others);

}  // namespace coop::capture
