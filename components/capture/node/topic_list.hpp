#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "runtime/raw_participant.hpp"

namespace coop::capture {

/// The topics of a domain as discovery tells them.
class TopicList {
 public:
  /// `partition`: endpoints of others are left out.
  explicit TopicList(std::string partition) : partition_(std::move(partition)) {}
  void take(const runtime::DiscoveryEvent& event);
  /// A table, or one JSON object a line, by topic.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string json() const;

 private:
  struct Topic {
    std::set<std::string> types;
    std::set<std::string> qos;
    std::multiset<std::string> writers;
    std::multiset<std::string> readers;
  };
  [[nodiscard]] std::map<std::string, Topic> topics() const;

  std::string partition_;
  std::map<runtime::EndpointId, runtime::DiscoveredEndpoint> endpoints_;
};

}  // namespace coop::capture
