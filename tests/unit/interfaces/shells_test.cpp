// What the shells really advertise and subscribe to, held against the table of topics.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/atomic_file.hpp"
#include "runtime/topics.hpp"
#include "unit/interfaces/endpoints.hpp"

namespace coop::test {
namespace {

using runtime::find_topic;
using runtime::lists;
using runtime::Qos;
using runtime::TopicInfo;

const std::filesystem::path kComponents = std::filesystem::path(COOP_SOURCE_DIR) / "components";

/// Programs by name, with what their shell's sources say.
std::map<std::string, SourceEndpoints> shells() {
  std::map<std::string, SourceEndpoints> result;
  for (const auto& entry : std::filesystem::directory_iterator(kComponents)) {
    const auto node = entry.path() / "node";
    if (!std::filesystem::exists(node / "main.cpp")) continue;
    std::string text = source_text(node);
    // Endpoints that several shells share are declared for them in the runtime.
    if (text.find("\"runtime/world_feed.hpp\"") != std::string::npos) {
      text += read_file(kComponents / "runtime/world_feed.cpp");
    }
    result[entry.path().filename()] = find_endpoints(text);
  }
  return result;
}

std::string enumerator(Qos qos) {
  switch (qos) {
    case Qos::kSensorStream:
      return "kSensorStream";
    case Qos::kStateLatched:
      return "kStateLatched";
    case Qos::kCommand:
      return "kCommand";
    case Qos::kEvent:
      return "kEvent";
    case Qos::kHeartbeat:
      return "kHeartbeat";
  }
  return "";
}

/// A program that stands for a person may touch every topic.
bool is_person(const std::string& program) {
  return program == "demo";
}

TEST(Shells, there_are_some) {
  EXPECT_FALSE(shells().empty());
}

TEST(Shells, every_topic_type_and_qos_stand_literally_in_the_call) {
  for (const auto& [program, found] : shells()) EXPECT_EQ(found.unreadable, 0) << program;
}

TEST(Shells, every_endpoint_is_in_the_table_with_its_type_qos_and_program) {
  for (const auto& [program, found] : shells()) {
    for (const Endpoint& endpoint : found.endpoints) {
      const TopicInfo* topic = find_topic(endpoint.topic);
      const std::string where =
          program + (endpoint.writes ? " writes " : " reads ") + endpoint.topic;
      ASSERT_NE(topic, nullptr) << where;
      EXPECT_EQ(endpoint.type, topic->type) << where;
      EXPECT_EQ(endpoint.qos, enumerator(topic->qos)) << where;
      if (is_person(program)) continue;
      EXPECT_TRUE(lists(endpoint.writes ? topic->writers : topic->readers, program)) << where;
    }
  }
}

TEST(Shells, every_program_in_the_table_has_the_endpoint) {
  const auto programs = shells();
  for (const TopicInfo& topic : runtime::all_topics()) {
    for (const auto& [program, found] : programs) {
      const auto has = [&, &endpoints = found.endpoints](bool writes) {
        return std::any_of(endpoints.begin(), endpoints.end(), [&](const Endpoint& endpoint) {
          return endpoint.topic == topic.name && endpoint.writes == writes;
        });
      };
      if (topic.writers != "all" && lists(topic.writers, program)) {
        EXPECT_TRUE(has(true)) << program << " does not write " << topic.name;
      }
      if (topic.readers != "all" && lists(topic.readers, program)) {
        EXPECT_TRUE(has(false)) << program << " does not read " << topic.name;
      }
    }
  }
}

TEST(Endpoints, are_found_in_source_text) {
  const auto found = find_endpoints(R"(
    using Scan = sensor_msgs::msg::LaserScan;
    using coop_msgs::msg::World;
    // node.advertise<Scan>("old", Qos::kEvent);
    node.subscribe<Scan>("scan", runtime::Qos::kSensorStream, [this](const Scan& scan) {});
    out_(node.advertise<std_msgs::msg::String>(
        "robot_description", Qos::kStateLatched)),
    node.publish_transform("map", "odom", stamp, pose);
    node.advertise<Scan>(topic_name, Qos::kEvent);
    node.subscribe<World>("world", Qos::kStateLatched, handle);
  )");
  EXPECT_EQ(found.unreadable, 1);
  ASSERT_EQ(found.endpoints.size(), 4U);
  EXPECT_EQ(found.endpoints[0].topic, "scan");
  EXPECT_EQ(found.endpoints[0].type, "sensor_msgs/LaserScan");
  EXPECT_EQ(found.endpoints[0].qos, "kSensorStream");
  EXPECT_FALSE(found.endpoints[0].writes);
  EXPECT_EQ(found.endpoints[1].type, "std_msgs/String");
  EXPECT_TRUE(found.endpoints[1].writes);
  EXPECT_EQ(found.endpoints[2].type, "coop_msgs/World");
  EXPECT_EQ(found.endpoints[3].topic, "tf");
}

}  // namespace
}  // namespace coop::test
