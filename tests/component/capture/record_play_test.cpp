// Recorder and player as components, over DDS within one process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <optional>

#include "capture/mcap/reader.hpp"
#include "capture/node/play_node.hpp"
#include "capture/node/record_node.hpp"
#include "coop_msgs/msg/NavigationStatus.h"
#include "runtime/dds_transport.hpp"
#include "std_msgs/msg/String.h"
#include "support/temporary_folder.hpp"

namespace coop::capture {
namespace {

using coop_msgs::msg::NavigationStatus;
using std_msgs::msg::String;
using Wall = std::chrono::steady_clock;

int test_domain() {
  return 60 + static_cast<int>(::getpid()) % 40;
}

String text(const std::string& data) {
  String message;
  message.data(data);
  return message;
}

NavigationStatus status(const std::string& source, const std::string& detail) {
  NavigationStatus message;
  message.source(source);
  message.detail(detail);
  return message;
}

/// A program of this process, with a participant of its own.
class Program {
 public:
  explicit Program(const std::string& name)
      : transport_({.domain = test_domain(), .participant_name = name, .partition = {}}),
        executor_(clock_),
        node_(options(name), transport_, clock_, executor_) {}

  runtime::Node& node() { return node_; }
  runtime::Executor& executor() { return executor_; }

 private:
  static runtime::Options options(const std::string& name) {
    runtime::Options options;
    options.name = name;
    options.domain = test_domain();
    return options;
  }
  runtime::DdsTransport transport_;
  runtime::SystemClock clock_;
  runtime::Executor executor_;
  runtime::Node node_;
};

class RecordAndPlay : public ::testing::Test {
 protected:
  /// Lets the programs run until the condition holds.
  bool wait_until(const std::function<bool()>& condition, std::vector<Program*> programs) {
    const auto end = Wall::now() + std::chrono::seconds(30);
    while (!condition()) {
      if (Wall::now() > end) return false;
      for (Program* program : programs) {
        program->executor().wait_and_run(std::chrono::milliseconds(1));
      }
    }
    return true;
  }
  RecordConfig record_config() const {
    RecordConfig config;
    config.output = folder_.path();
    config.exclude = {"component_status"};
    return config;
  }
  [[nodiscard]] std::filesystem::path capture() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      return entry.path();
    }
    return {};
  }

  /// A hundred messages on /chatter, three latched ones of two keys on /status.
  void record_something() {
    Program talker("talker");
    Program recorder("record");
    auto chatter = talker.node().advertise<String>("chatter", runtime::Qos::kEvent);
    auto latched = talker.node().advertise<NavigationStatus>("status", runtime::Qos::kStateLatched);
    latched.publish(status("a", "old"));
    latched.publish(status("b", "only"));
    latched.publish(status("a", "new"));
    std::optional<RecordNode> record(std::in_place, recorder.node(), record_config());
    ASSERT_TRUE(wait_until([&] { return chatter.has_subscribers() && latched.has_subscribers(); },
                           {&talker, &recorder}));
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(chatter.publish(text(std::to_string(i))));
    chatter.wait_for_acknowledgments(std::chrono::seconds(10));
    latched.wait_for_acknowledgments(std::chrono::seconds(10));
    recorder.node().stop();
  }

  test::TemporaryFolder folder_;
};

TEST_F(RecordAndPlay, EverySampleOfAReliableTopicIsOnRecordWithItsWriter) {
  record_something();
  mcap::Reader reader(capture());
  ASSERT_TRUE(reader.summary().complete);
  std::map<std::string, int> counts;
  auto cursor = reader.messages();
  while (const auto message = cursor.next()) {
    ++counts[message->channel->topic];
    EXPECT_EQ(message->channel->metadata.at("component"), "talker");
    EXPECT_LE(message->message.publish_time, message->message.log_time);
  }
  EXPECT_THAT(counts, ::testing::UnorderedElementsAre(::testing::Pair("/chatter", 100),
                                                      ::testing::Pair("/status", 2)));
}

TEST_F(RecordAndPlay, WhatIsPlayedIsWhatWasRecordedAlsoForThoseWhoComeLate) {
  record_something();
  Program listener("listener");
  std::vector<std::string> heard;
  std::vector<std::string> states;
  listener.node().subscribe<String>("chatter", runtime::Qos::kEvent, [&](const String& message) {
    heard.push_back(message.data());
  });
  Program player("play");
  PlayConfig config;
  config.file = capture();
  config.rate = 0.0;
  PlayNode play(player.node(), config);
  ASSERT_TRUE(wait_until([&] { return player.node().wants_to_end(); }, {&player, &listener}));
  EXPECT_EQ(player.node().exit_code(), 0);
  ASSERT_TRUE(wait_until([&] { return heard.size() == 100; }, {&listener}));
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(heard[i], std::to_string(i));

  listener.node().subscribe<NavigationStatus>(
      "status", runtime::Qos::kStateLatched, [&](const NavigationStatus& message) {
        states.push_back(message.source() + " " + message.detail());
      });
  ASSERT_TRUE(wait_until([&] { return states.size() == 2; }, {&listener, &player}));
  EXPECT_THAT(states, ::testing::UnorderedElementsAre("a new", "b only"));
}

TEST_F(RecordAndPlay, MessagesComeAtTheirTimesAtAnyRate) {
  RecordingOptions options;
  options.path = folder_.path() / "paced.mcap";
  Recording recording(options);
  WriterInfo writer;
  writer.topic = "/chatter";
  writer.dds_type = "std_msgs::msg::dds_::String_";
  const auto channel = recording.add_channel(writer);
  for (std::uint64_t i = 1; i <= 21; ++i) {
    const Time at = time_from_seconds(1000.0 + 0.1 * static_cast<double>(i));
    recording.write(channel, i, at, at, std::vector<std::uint8_t>{0, 1, 0, 0, 2, 0, 0, 0, 'x', 0});
  }
  recording.close();
  Program listener("listener");
  std::vector<Wall::time_point> arrivals;
  listener.node().subscribe<String>("chatter", runtime::Qos::kEvent,
                                    [&](const String&) { arrivals.push_back(Wall::now()); });
  Program player("play");
  PlayConfig config;
  config.file = options.path;
  config.rate = 4.0;
  config.readers = {"/chatter"};
  PlayNode play(player.node(), config);
  ASSERT_TRUE(wait_until([&] { return arrivals.size() == 21; }, {&player, &listener}));
  // 2 s of the capture in 0.5 s; a busy machine delays, but nothing comes too early.
  EXPECT_GE(arrivals.back() - arrivals.front(), std::chrono::milliseconds(450));
  EXPECT_TRUE(wait_until([&] { return player.node().wants_to_end(); }, {&player, &listener}));
}

TEST_F(RecordAndPlay, APlayerWhomNobodyHearsSaysSoWhereSomebodyMust) {
  record_something();
  Program player("play");
  PlayConfig config;
  config.file = capture();
  config.readers = {"/chatter"};
  config.wait = 0.3;
  PlayNode play(player.node(), config);
  ASSERT_TRUE(wait_until([&] { return player.node().wants_to_end(); }, {&player}));
  EXPECT_EQ(player.node().exit_code(), 1);
}

}  // namespace
}  // namespace coop::capture
