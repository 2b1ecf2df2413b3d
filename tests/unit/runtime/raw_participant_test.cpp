// Topics handled as bytes, by programs that do not know them, over DDS.
#include "runtime/raw_participant.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "coop_msgs/msg/NavigationStatus.h"
#include "runtime/topics.hpp"
#include "std_msgs/msg/String.h"
#include "unit/runtime/arrivals.hpp"

namespace coop::runtime {
namespace {

using coop_msgs::msg::NavigationStatus;
using StringMessage = std_msgs::msg::String;

class RawTopics : public ::testing::Test {
 protected:
  static DdsOptions options(const std::string& name, const std::string& partition = "") {
    return {.domain = test_domain() + 1, .participant_name = name, .partition = partition};
  }
  static StringMessage text(const std::string& data) {
    StringMessage message;
    message.data(data);
    return message;
  }
  /// Waits until discovery has told of an endpoint on the topic.
  std::optional<DiscoveryEvent> find(DiscoveryEvent::Kind kind, const std::string& topic,
                                     bool is_writer = true) {
    std::optional<DiscoveryEvent> found;
    arrivals_.wait_until([&] {
      for (DiscoveryEvent& event : raw_.take_events()) {
        if (event.kind != kind || event.endpoint.is_writer != is_writer) continue;
        if (event.endpoint.topic.name == topic) found = std::move(event);
      }
      return found.has_value();
    });
    return found;
  }
  std::unique_ptr<RawReader> read(const DiscoveredEndpoint& endpoint) {
    return raw_.create_reader(endpoint.topic, reader_for(endpoint.qos), [this](RawSample&& sample) {
      const std::scoped_lock lock(mutex_);
      samples_.push_back(std::move(sample));
    });
  }
  std::size_t count() {
    const std::scoped_lock lock(mutex_);
    return samples_.size();
  }

  Arrivals arrivals_;
  std::mutex mutex_;
  std::vector<RawSample> samples_;
  RawParticipant raw_{options("raw"), arrivals_.callback()};
  DdsTransport typed_{options("talker")};
};

TEST_F(RawTopics, AreFoundWithTypeQosAndTheNameOfTheirProgram) {
  const auto writer =
      typed_.create_writer("status", message_type<NavigationStatus>(), Qos::kStateLatched);
  const auto found = find(DiscoveryEvent::Kind::kFound, "rt/status");
  ASSERT_TRUE(found);
  const DiscoveredEndpoint& endpoint = found->endpoint;
  EXPECT_EQ(endpoint.id.text(), writer->id());
  EXPECT_EQ(endpoint.participant, "talker");
  EXPECT_EQ(endpoint.topic.type, dds_type_name("coop_msgs/NavigationStatus"));
  EXPECT_TRUE(endpoint.topic.keyed);
  EXPECT_TRUE(endpoint.qos.reliable);
  EXPECT_TRUE(endpoint.qos.transient_local);
  EXPECT_EQ(endpoint.qos.deadline, Duration::max());
}

TEST_F(RawTopics, TellsOfReadersAndOfEndpointsThatAreGone) {
  auto reader = typed_.create_reader("chatter", message_type<StringMessage>(), Qos::kEvent, [] {});
  EXPECT_TRUE(find(DiscoveryEvent::Kind::kFound, "rt/chatter", false));
  reader.reset();
  EXPECT_TRUE(find(DiscoveryEvent::Kind::kLost, "rt/chatter", false));
}

TEST_F(RawTopics, SamplesArriveAsTheyAreOnTheWireInOrderAndWithTheirTimes) {
  const auto writer = typed_.create_writer("chatter", message_type<StringMessage>(), Qos::kEvent);
  const auto found = find(DiscoveryEvent::Kind::kFound, "rt/chatter");
  ASSERT_TRUE(found);
  const auto reader = read(found->endpoint);
  ASSERT_TRUE(arrivals_.wait_until(
      [&] { return reader->hears(found->endpoint.id) && writer->matched_readers() == 1; }));
  const auto before = std::chrono::system_clock::now();
  for (int i = 0; i < 100; ++i) {
    const StringMessage message = text("message " + std::to_string(i));
    ASSERT_TRUE(writer->write(&message));
  }
  ASSERT_TRUE(arrivals_.wait_until([&] { return count() == 100; }));
  for (std::size_t i = 0; i < 100; ++i) {
    const RawSample& sample = samples_[i];
    StringMessage message;
    ASSERT_TRUE(from_wire(sample.bytes, message));
    EXPECT_EQ(message.data(), "message " + std::to_string(i));
    EXPECT_EQ(sample.sequence, i + 1);
    EXPECT_EQ(sample.writer, found->endpoint.id);
    EXPECT_GE(sample.source_time.time_since_epoch(), before.time_since_epoch());
    EXPECT_LE(sample.source_time, sample.reception_time);
  }
}

TEST_F(RawTopics, ALateReaderOfALatchedKeyedTopicGetsTheLastWordOfEachKey) {
  const auto writer =
      typed_.create_writer("status", message_type<NavigationStatus>(), Qos::kStateLatched);
  for (const char* source : {"a", "b", "a", "c"}) {
    NavigationStatus status;
    status.source(source);
    ASSERT_TRUE(writer->write(&status));
  }
  const auto found = find(DiscoveryEvent::Kind::kFound, "rt/status");
  ASSERT_TRUE(found);
  const auto reader = read(found->endpoint);
  ASSERT_TRUE(arrivals_.wait_until([&] { return count() == 3; }));
  std::vector<std::string> sources;
  for (const RawSample& sample : samples_) {
    NavigationStatus status;
    ASSERT_TRUE(from_wire(sample.bytes, status));
    sources.push_back(status.source());
  }
  EXPECT_THAT(sources, ::testing::ElementsAre("b", "a", "c"));
}

TEST_F(RawTopics, WrittenAsBytesReachTypedReadersWithTheirKeys) {
  WireQos latched;
  latched.transient_local = true;
  latched.keep_all = false;
  const WireTopic topic{"rt/status", dds_type_name("coop_msgs/NavigationStatus"), true};
  const auto writer = raw_.create_writer(topic, latched);
  for (const auto& [source, detail] : std::vector<std::pair<std::string, std::string>>{
           {"a", "old"}, {"b", "only"}, {"a", "new"}}) {
    NavigationStatus status;
    status.source(source);
    status.detail(detail);
    std::vector<std::uint8_t> bytes;
    message_type<NavigationStatus>().serialize(&status, bytes);
    ASSERT_TRUE(writer->write(bytes));
  }
  const auto reader = typed_.create_reader("status", message_type<NavigationStatus>(),
                                           Qos::kStateLatched, arrivals_.callback());
  std::vector<std::string> sources;
  ASSERT_TRUE(arrivals_.wait_until([&] {
    Sample sample;
    while (reader->take(sample)) {
      const auto& status = *static_cast<const NavigationStatus*>(sample.message.get());
      sources.push_back(status.source() + " " + status.detail());
    }
    return sources.size() >= 2;
  }));
  EXPECT_THAT(sources, ::testing::UnorderedElementsAre("a new", "b only"));
}

TEST_F(RawTopics, WhoJoinsAnewIsToldOfEverythingAgainAndHearsAndIsHeard) {
  const auto writer = typed_.create_writer("chatter", message_type<StringMessage>(), Qos::kEvent);
  const auto hears = typed_.create_reader("echo", message_type<StringMessage>(), Qos::kEvent,
                                          arrivals_.callback());
  const auto found = find(DiscoveryEvent::Kind::kFound, "rt/chatter");
  ASSERT_TRUE(found);
  const auto reader = read(found->endpoint);
  const auto tells = raw_.create_writer({"rt/echo", dds_type_name("std_msgs/String")}, {});
  const auto matched = [&] {
    return reader->hears(found->endpoint.id) && writer->matched_readers() == 1 &&
           hears->hears(tells->id().text()) && tells->matched_readers() == 1;
  };
  ASSERT_TRUE(arrivals_.wait_until(matched));
  EXPECT_FALSE(raw_.mend());
  (void)raw_.take_events();
  const std::string old_id = tells->id().text();
  raw_.join_anew();
  std::vector<DiscoveryEvent::Kind> told;
  ASSERT_TRUE(arrivals_.wait_until([&] {
    for (const DiscoveryEvent& event : raw_.take_events()) {
      if (event.endpoint.id == found->endpoint.id) told.push_back(event.kind);
    }
    return told.size() >= 2;
  }));
  EXPECT_THAT(told,
              ::testing::ElementsAre(DiscoveryEvent::Kind::kLost, DiscoveryEvent::Kind::kFound));
  ASSERT_TRUE(arrivals_.wait_until(matched));
  EXPECT_FALSE(hears->hears(old_id));
  const StringMessage message = text("again");
  std::vector<std::uint8_t> bytes;
  message_type<StringMessage>().serialize(&message, bytes);
  ASSERT_TRUE(writer->write(&message) && tells->write(bytes));
  EXPECT_TRUE(arrivals_.wait_until([&] { return count() == 1; }));
  Sample sample;
  EXPECT_TRUE(arrivals_.wait_until([&] { return hears->take(sample); }));
}

TEST_F(RawTopics, BytesThatAreNoMessageAreRefused) {
  const auto writer = raw_.create_writer({"rt/chatter", dds_type_name("std_msgs/String")}, {});
  EXPECT_FALSE(writer->write({0, 1}));
  StringMessage message;
  EXPECT_FALSE(from_wire({0, 1, 0, 0, 255, 0, 0, 0, 'x'}, message));
}

}  // namespace
}  // namespace coop::runtime
