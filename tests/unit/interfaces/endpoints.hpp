#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace coop::test {

/// A topic that a source file advertises or subscribes to.
struct Endpoint {
  std::string topic;
  std::string type;  ///< "package/Type", or as written where it is no message type
  std::string qos;   ///< "kEvent"
  bool writes = false;
};

struct SourceEndpoints {
  std::vector<Endpoint> endpoints;
  /// Calls of advertise<...> or subscribe<...> that could not be read: topic or QoS is not a
  /// literal.
  int unreadable = 0;
};

/// Reads calls such as `node.advertise<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream)`
/// from C++ text. Aliases
/// (`using Scan = sensor_msgs::msg::LaserScan;`, `using sensor_msgs::msg::LaserScan;`) of the same
/// text are resolved. The runtime's own publish_transform and publish_static_transform count as
/// writers of tf and tf_static, and transforms() as a reader of both.
SourceEndpoints find_endpoints(const std::string& text);

/// Text of all .hpp and .cpp files directly in the folder.
std::string source_text(const std::filesystem::path& folder);

}  // namespace coop::test
