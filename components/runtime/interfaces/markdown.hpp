#pragma once
#include <string>

namespace coop::runtime {

/// The text of docs/interfaces.md: topics from the table in topics.hpp, QoS from the policies that
/// dds_qos.hpp sets.
[[nodiscard]] std::string interfaces_markdown();

}  // namespace coop::runtime
