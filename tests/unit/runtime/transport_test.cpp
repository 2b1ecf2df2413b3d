// The promises of the intents, on both transports.
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <set>
#include <vector>

#include "coop_msgs/msg/NavigationStatus.h"
#include "runtime/dds_transport.hpp"
#include "runtime/in_process_transport.hpp"
#include "std_msgs/msg/String.h"
#include "unit/runtime/arrivals.hpp"

namespace coop::runtime {
namespace {

using coop_msgs::msg::NavigationStatus;
using StringMessage = std_msgs::msg::String;

std::unique_ptr<Transport> make_transport(const std::string& kind, const std::string& name,
                                          bool reliable_streams = false) {
  static InProcessTransport bus;
  if (kind == "dds") {
    return std::make_unique<DdsTransport>(DdsOptions{.domain = test_domain(),
                                                     .participant_name = name,
                                                     .partition = "transport_test",
                                                     .reliable_streams = reliable_streams});
  }
  return std::make_unique<InProcessTransport>(bus);  // copies share the bus
}

class TransportTest : public ::testing::TestWithParam<std::string> {
 protected:
  template <class Message>
  std::unique_ptr<Writer> writer(const std::string& topic, Qos qos) {
    return a_->create_writer(topic, message_type<Message>(), qos);
  }
  template <class Message>
  std::unique_ptr<Reader> reader(const std::string& topic, Qos qos) {
    return b_->create_reader(topic, message_type<Message>(), qos, arrivals_.callback());
  }
  bool matched(const Writer& writer, const Reader& reader) {
    return arrivals_.wait_until(
        [&] { return writer.matched_readers() > 0 && reader.matched_writers() > 0; });
  }
  std::unique_ptr<Transport> a_ = make_transport(GetParam(), "a");
  std::unique_ptr<Transport> b_ = make_transport(GetParam(), "b");
  Arrivals arrivals_;
};

TEST_P(TransportTest, EventsArriveAllInOrderWithRisingSequence) {
  const auto from = writer<StringMessage>("events", Qos::kEvent);
  const auto to = reader<StringMessage>("events", Qos::kEvent);
  ASSERT_TRUE(matched(*from, *to));
  StringMessage message;
  for (int i = 1; i <= 500; ++i) {
    message.data(std::to_string(i));
    ASSERT_TRUE(from->write(&message));
  }
  EXPECT_EQ(from->sequence(), 500U);
  for (int i = 1; i <= 500; ++i) {
    Sample sample;
    ASSERT_TRUE(arrivals_.wait_until([&] { return to->take(sample); })) << i;
    EXPECT_EQ(static_cast<const StringMessage*>(sample.message.get())->data(), std::to_string(i));
    EXPECT_EQ(sample.sequence, static_cast<std::uint64_t>(i));
  }
}

TEST_P(TransportTest, ALatchedStateReachesALateReaderOncePerKey) {
  const auto from = writer<NavigationStatus>("latched", Qos::kStateLatched);
  NavigationStatus status;
  for (const auto& [source, detail] :
       {std::pair{"dwa", "old"}, std::pair{"global_planner", "planning"},
        std::pair{"dwa", "new"}}) {
    status.source(source);
    status.detail(detail);
    ASSERT_TRUE(from->write(&status));
  }
  const auto late = reader<NavigationStatus>("latched", Qos::kStateLatched);
  std::map<std::string, std::string> seen;
  Sample sample;
  ASSERT_TRUE(arrivals_.wait_until([&] {
    while (late->take(sample)) {
      const auto& got = *static_cast<const NavigationStatus*>(sample.message.get());
      seen[got.source()] = got.detail();
    }
    return seen.size() == 2;
  }));
  EXPECT_EQ(seen["dwa"], "new");
  EXPECT_EQ(seen["global_planner"], "planning");
}

/// As with tf_static: several programs each have their last word, and the reader is slow to take
/// them.
TEST_P(TransportTest, TheLastStateOfEveryLatchedWriterReachesALateReader) {
  std::vector<std::unique_ptr<Writer>> writers;
  StringMessage message;
  for (const char* text : {"one", "two", "three", "four"}) {
    writers.push_back(writer<StringMessage>("static", Qos::kStateLatched));
    message.data(text);
    ASSERT_TRUE(writers.back()->write(&message));
  }
  const auto late = reader<StringMessage>("static", Qos::kStateLatched);
  for (const auto& from : writers) {
    ASSERT_TRUE(arrivals_.wait_until([&] { return from->matched_readers() == 1; }));
    ASSERT_TRUE(from->wait_for_acknowledgments(std::chrono::seconds(20)));
  }
  std::set<std::string> seen;
  for (Sample sample; late->take(sample);) {
    seen.insert(static_cast<const StringMessage*>(sample.message.get())->data());
  }
  EXPECT_EQ(seen, (std::set<std::string>{"one", "two", "three", "four"}));
}

TEST_P(TransportTest, AStreamKeepsTheNewestWhenTheReaderIsLate) {
  const auto from = writer<StringMessage>("stream", Qos::kSensorStream);
  const auto to = reader<StringMessage>("stream", Qos::kSensorStream);
  ASSERT_TRUE(matched(*from, *to));
  StringMessage message;
  for (int i = 1; i <= 50; ++i) {
    message.data(std::to_string(i));
    from->write(&message);
  }
  Sample sample;
  std::string last;
  int taken = 0;
  ASSERT_TRUE(arrivals_.wait_until([&] {
    while (to->take(sample)) {
      last = static_cast<const StringMessage*>(sample.message.get())->data();
      ++taken;
    }
    return last == "50";
  }));
  EXPECT_LE(taken, 50);
}

TEST_P(TransportTest, ATopicCannotCarryTwoTypes) {
  const auto from = writer<StringMessage>("typed", Qos::kEvent);
  EXPECT_THROW((void)writer<NavigationStatus>("typed", Qos::kEvent), std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(Transports, TransportTest, ::testing::Values("dds", "in_process"),
                         [](const auto& kind) { return kind.param; });

TEST(DdsTransportTest, ReliableStreamsLoseNothing) {
  const auto a = make_transport("dds", "a", true);
  const auto b = make_transport("dds", "b", true);
  Arrivals arrivals;
  const auto from = a->create_writer("log", message_type<StringMessage>(), Qos::kSensorStream);
  const auto to = b->create_reader("log", message_type<StringMessage>(), Qos::kSensorStream,
                                   arrivals.callback());
  ASSERT_TRUE(arrivals.wait_until([&] { return from->matched_readers() > 0; }));
  StringMessage message;
  message.data(std::string(2000, 'x'));
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(from->write(&message));
  ASSERT_TRUE(from->wait_for_acknowledgments(std::chrono::seconds(20)));
  Sample sample;
  int taken = 0;
  while (to->take(sample)) ++taken;
  EXPECT_EQ(taken, 1000);
}

TEST(DdsTransportTest, AnotherPartitionIsNotHeard) {
  const auto a = make_transport("dds", "a");
  DdsTransport other({.domain = test_domain(), .participant_name = "o", .partition = "other"});
  Arrivals arrivals;
  const auto from = a->create_writer("shared", message_type<StringMessage>(), Qos::kEvent);
  const auto deaf = other.create_reader("shared", message_type<StringMessage>(), Qos::kEvent,
                                        arrivals.callback());
  const auto b = make_transport("dds", "b");
  const auto hears =
      b->create_reader("shared", message_type<StringMessage>(), Qos::kEvent, arrivals.callback());
  ASSERT_TRUE(arrivals.wait_until([&] { return from->matched_readers() > 0; }));
  StringMessage message;
  from->write(&message);
  Sample sample;
  ASSERT_TRUE(arrivals.wait_until([&] { return hears->take(sample); }));
  EXPECT_FALSE(deaf->take(sample));
  EXPECT_EQ(deaf->matched_writers(), 0);
}

/// Two programs, of which one stood still for so long that it joins anew.
class Rejoin : public ::testing::Test {
 protected:
  static DdsTransport join(const std::string& name, bool complete = false) {
    return DdsTransport({.domain = test_domain(),
                         .participant_name = name,
                         .partition = "rejoin",
                         .complete = complete});
  }
  bool write(Writer& writer, const std::string& text) {
    StringMessage message;
    message.data(text);
    return writer.write(&message);
  }
  std::string next(Reader& reader) {
    Sample sample;
    if (!arrivals_.wait_until([&] { return reader.take(sample); })) return "nothing";
    return static_cast<const StringMessage*>(sample.message.get())->data();
  }
  std::unique_ptr<Writer> writer(DdsTransport& transport, const std::string& topic, Qos qos) {
    return transport.create_writer(topic, message_type<StringMessage>(), qos);
  }
  std::unique_ptr<Reader> reader(DdsTransport& transport, const std::string& topic, Qos qos) {
    return transport.create_reader(topic, message_type<StringMessage>(), qos, arrivals_.callback());
  }
  bool matched(const Writer& from, const Reader& to) {
    return arrivals_.wait_until([&] {
      return from.reaches(to.id()) && to.hears(from.id()) && from.matched_readers() == 1;
    });
  }
  Arrivals arrivals_;
};

TEST_F(Rejoin, SomebodyWhoWasStoppedIsHeardAndHearsAgainUnderNewIds) {
  DdsTransport stopped = join("stopped");
  DdsTransport other = join("other");
  const auto to_other = writer(stopped, "out", Qos::kEvent);
  const auto from_other = reader(stopped, "in", Qos::kEvent);
  const auto hears = reader(other, "out", Qos::kEvent);
  const auto tells = writer(other, "in", Qos::kEvent);
  ASSERT_TRUE(matched(*to_other, *hears) && matched(*tells, *from_other));
  ASSERT_TRUE(write(*to_other, "before"));
  EXPECT_EQ(next(*hears), "before");
  EXPECT_EQ(stopped.mend(), std::nullopt);
  const std::string old_id = to_other->id();
  stopped.note_pause(std::chrono::milliseconds(7250));
  EXPECT_EQ(stopped.mend(), "stopped for 7.2 s: joined anew");
  EXPECT_EQ(stopped.mend(), std::nullopt);
  EXPECT_NE(to_other->id(), old_id);
  EXPECT_EQ(to_other->sequence(), 0U);
  ASSERT_TRUE(matched(*to_other, *hears) && matched(*tells, *from_other));
  EXPECT_FALSE(hears->hears(old_id));
  ASSERT_TRUE(write(*to_other, "after") && write(*tells, "answer"));
  EXPECT_EQ(next(*hears), "after");
  EXPECT_EQ(next(*from_other), "answer");
}

TEST_F(Rejoin, TheLastWordOfALatchedTopicIsToldToLateReadersAfterwards) {
  DdsTransport stopped = join("stopped");
  const auto state = writer(stopped, "state", Qos::kStateLatched);
  ASSERT_TRUE(write(*state, "old") && write(*state, "new"));
  stopped.note_pause(std::chrono::seconds(7));
  ASSERT_TRUE(stopped.mend());
  DdsTransport other = join("other");
  EXPECT_EQ(next(*reader(other, "state", Qos::kStateLatched)), "new");
}

TEST_F(Rejoin, WhatHadArrivedBeforeIsNotLost) {
  DdsTransport stopped = join("stopped");
  DdsTransport other = join("other");
  const auto from_other = reader(stopped, "in", Qos::kEvent);
  const auto tells = writer(other, "in", Qos::kEvent);
  ASSERT_TRUE(matched(*tells, *from_other));
  for (const char* text : {"one", "two"}) ASSERT_TRUE(write(*tells, text));
  ASSERT_TRUE(tells->wait_for_acknowledgments(std::chrono::seconds(20)));
  stopped.note_pause(std::chrono::seconds(7));
  ASSERT_TRUE(stopped.mend());
  ASSERT_TRUE(matched(*tells, *from_other));
  ASSERT_TRUE(write(*tells, "three"));
  EXPECT_EQ(next(*from_other), "one");
  EXPECT_EQ(next(*from_other), "two");
  EXPECT_EQ(next(*from_other), "three");
}

TEST_F(Rejoin, InLockstepNobodyDoes) {
  DdsTransport stopped = join("stopped", true);
  const auto state = writer(stopped, "state", Qos::kStateLatched);
  const std::string id = state->id();
  stopped.note_pause(std::chrono::seconds(7));
  EXPECT_EQ(stopped.mend(), std::nullopt);
  EXPECT_EQ(state->id(), id);
}

}  // namespace
}  // namespace coop::runtime
