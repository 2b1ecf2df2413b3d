#include "capture/node/topic_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "capture/node/wire.hpp"
#include "capture/traffic/topic_names.hpp"

namespace coop::capture {
namespace {

std::string qos_text(const runtime::WireQos& qos) {
  return std::string(qos.reliable ? "reliable" : "best effort") +
         (qos.transient_local ? ", latched" : "");
}

}  // namespace

void TopicList::take(const runtime::DiscoveryEvent& event) {
  if (event.kind == runtime::DiscoveryEvent::Kind::kLost) {
    endpoints_.erase(event.endpoint.id);
  } else if (same_partition(partition_, event.endpoint.qos.partitions)) {
    endpoints_[event.endpoint.id] = event.endpoint;
  }
}

std::map<std::string, TopicList::Topic> TopicList::topics() const {
  std::map<std::string, Topic> topics;
  for (const auto& [id, endpoint] : endpoints_) {
    Topic& topic = topics[shown_topic(endpoint.topic.name)];
    topic.types.insert(shown_type(endpoint.topic.type));
    const std::string name = endpoint.participant.empty() ? "?" : endpoint.participant;
    (endpoint.is_writer ? topic.writers : topic.readers).insert(name);
    if (endpoint.is_writer) topic.qos.insert(qos_text(endpoint.qos));
  }
  return topics;
}

std::string TopicList::text() const {
  std::vector<std::array<std::string, 5>> rows{{"TOPIC", "TYPE", "OFFERED", "WRITERS", "READERS"}};
  for (const auto& [name, topic] : topics()) {
    rows.push_back({name, fmt::format("{}", fmt::join(topic.types, " and ")),
                    fmt::format("{}", fmt::join(topic.qos, " and ")),
                    fmt::format("{}", fmt::join(topic.writers, ", ")),
                    fmt::format("{}", fmt::join(topic.readers, ", "))});
  }
  std::array<std::size_t, 4> widths{};
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string out;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i)
      out += fmt::format("{:{}}  ", row[i], widths[i]);
    out += row[4] + "\n";
  }
  return out;
}

std::string TopicList::json() const {
  std::string out;
  for (const auto& [name, topic] : topics()) {
    const nlohmann::ordered_json line{{"topic", name},
                                      {"types", topic.types},
                                      {"offered", topic.qos},
                                      {"writers", topic.writers},
                                      {"readers", topic.readers}};
    out += line.dump() + "\n";
  }
  return out;
}

}  // namespace coop::capture
