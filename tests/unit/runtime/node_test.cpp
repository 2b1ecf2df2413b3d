#include "runtime/node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coop_msgs/msg/ComponentStatus.h"
#include "core/config/fields.hpp"
#include "std_msgs/msg/String.h"
#include "support/component_fixture.hpp"

namespace coop::runtime {
namespace {

using coop_msgs::msg::ComponentStatus;
using StringMessage = std_msgs::msg::String;
using std::chrono::milliseconds;

/// Repeats what it hears, every 100 ms.
class Parrot {
 public:
  struct Config {
    std::string prefix = "I heard ";
    void describe(config::Fields& fields) { fields.text("prefix", prefix, {}); }
  };
  Parrot(Node& node, Config config)
      : config_(std::move(config)), out_(node.advertise<StringMessage>("echo", Qos::kEvent)) {
    node.subscribe<StringMessage>(
        "voice", Qos::kEvent, [this](const StringMessage& message) { heard_ = message.data(); });
    node.every(milliseconds(100), [this] {
      StringMessage message;
      message.data(config_.prefix + heard_);
      out_.publish(message);
    });
    node.on_stop([this] {
      StringMessage message;
      message.data("bye after " + heard_);
      out_.publish(message);
    });
  }

 private:
  Config config_;
  std::string heard_ = "nothing";
  Publisher<StringMessage> out_;
};

/// Says of which topics the last messages were waited for, and how that ended.
class AskedTransport : public InProcessTransport {
 public:
  explicit AskedTransport(bool acknowledged) : acknowledged_(acknowledged) {}

  std::unique_ptr<Writer> create_writer(const std::string& topic, const MessageType& type,
                                        Qos qos) override {
    return std::make_unique<AskedWriter>(*this, topic,
                                         InProcessTransport::create_writer(topic, type, qos));
  }
  [[nodiscard]] const std::vector<std::string>& asked() const { return asked_; }

 private:
  class AskedWriter : public Writer {
   public:
    AskedWriter(AskedTransport& transport, std::string topic, std::unique_ptr<Writer> writer)
        : transport_(transport), topic_(std::move(topic)), writer_(std::move(writer)) {}
    [[nodiscard]] const std::string& id() const override { return writer_->id(); }
    bool write(const void* message) override { return writer_->write(message); }
    [[nodiscard]] std::uint64_t sequence() const override { return writer_->sequence(); }
    [[nodiscard]] int matched_readers() const override { return writer_->matched_readers(); }
    [[nodiscard]] bool reaches(const std::string& reader) const override {
      return writer_->reaches(reader);
    }
    bool wait_for_acknowledgments(Duration timeout) override {
      EXPECT_GT(timeout, Duration{0});
      EXPECT_LE(timeout, std::chrono::seconds(1));
      transport_.asked_.push_back(topic_);
      return transport_.acknowledged_;
    }

   private:
    AskedTransport& transport_;
    std::string topic_;
    std::unique_ptr<Writer> writer_;
  };

  bool acknowledged_;
  std::vector<std::string> asked_;
};

std::vector<std::string> topics_waited_for_at_the_end(bool acknowledged) {
  AskedTransport transport(acknowledged);
  ManualClock clock;
  Executor executor(clock);
  Node node({}, transport, clock, executor);
  const auto state = node.advertise<StringMessage>("state", Qos::kStateLatched);
  const auto stream = node.advertise<StringMessage>("stream", Qos::kSensorStream);
  { const auto gone = node.advertise<StringMessage>("gone", Qos::kEvent); }
  const auto event = node.advertise<StringMessage>("event", Qos::kEvent);
  node.stop();
  return transport.asked();
}

TEST(NodeEndTest, WhatMustArriveIsWaitedForAndWhoDoesNotAnswerEndsTheWaiting) {
  using ::testing::ElementsAre;
  EXPECT_THAT(topics_waited_for_at_the_end(true), ElementsAre("state", "event"));
  EXPECT_THAT(topics_waited_for_at_the_end(false), ElementsAre("state"));
}

class NodeTest : public ::testing::Test {
 protected:
  test::ComponentFixture world_;
};

TEST_F(NodeTest, CallbacksAndTimersRunOnTheClockOfTheTest) {
  const auto echo = world_.collect<StringMessage>("echo", Qos::kEvent);
  auto voice = world_.tester().advertise<StringMessage>("voice", Qos::kEvent);
  world_.add<Parrot>("parrot", {});
  world_.advance(milliseconds(250));
  StringMessage message;
  message.data("quack");
  voice.publish(message);
  world_.advance(milliseconds(100));
  ASSERT_EQ(echo->size(), 3U);
  EXPECT_EQ(echo->at(1).data(), "I heard nothing");
  EXPECT_EQ(echo->at(2).data(), "I heard quack");
}

TEST_F(NodeTest, WhatArrivedBeforeTheStopIsHandledBeforeTheStopCallbacks) {
  const auto echo = world_.collect<StringMessage>("echo", Qos::kEvent);
  auto voice = world_.tester().advertise<StringMessage>("voice", Qos::kEvent);
  world_.add<Parrot>("parrot", {});
  StringMessage message;
  message.data("quack");
  voice.publish(message);
  world_.remove("parrot");
  ASSERT_EQ(echo->size(), 1U);
  EXPECT_EQ(echo->front().data(), "bye after quack");
}

TEST_F(NodeTest, HealthIsReportedAtEveryChangeWithItsReason) {
  const auto statuses = world_.collect<ComponentStatus>("component_status", Qos::kHeartbeat);
  world_.add<Parrot>("parrot", {});
  Node& node = world_.node_of("parrot");
  node.set_degraded("no voice for 1 s");
  node.set_degraded("no voice for 1 s");
  node.set_ready();
  world_.settle();
  std::vector<std::pair<int, std::string>> changes;
  for (const ComponentStatus& status : *statuses) {
    if (status.name() != "parrot") continue;
    const std::pair<int, std::string> now{status.state(), status.detail()};
    if (changes.empty() || changes.back() != now) changes.push_back(now);
  }
  const std::vector<std::pair<int, std::string>> expected{
      {1, ""}, {2, "no voice for 1 s"}, {1, ""}};
  EXPECT_EQ(changes, expected);
}

TEST_F(NodeTest, TheHeartBeatsOnDuringLongWorkTwiceASecond) {
  const auto statuses = world_.collect<ComponentStatus>("component_status", Qos::kHeartbeat);
  world_.add<Parrot>("parrot", {});
  Node& node = world_.node_of("parrot");
  const std::size_t before = statuses->size();
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::steady_clock::now() - start; };
  // Work that never gives the executor a turn.
  while (elapsed() < std::chrono::milliseconds(1100)) node.keep_alive();
  world_.settle();
  EXPECT_GE(statuses->size() - before, 2U);
  EXPECT_LE(statuses->size() - before, 5U) << "not at every call";
}

TEST_F(NodeTest, TransformsTravelBetweenNodesAlsoToLateOnes) {
  world_.add<Parrot>("parrot", {});
  Node& parrot = world_.node_of("parrot");
  parrot.publish_static_transform("base_link", "laser_link", to_pose3({0.6, 0, 0}));
  parrot.publish_static_transform("base_link", "camera_link", to_pose3({0.7, 0, 0}));
  const TransformBuffer& transforms = world_.tester().transforms();
  world_.settle();
  parrot.publish_transform("odom", "base_link", world_.now(), Pose2{1, 0, 0});
  world_.settle();
  const auto pose = transforms.lookup("odom", "laser_link", world_.now());
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->translation().x(), 1.6, 1e-12);
  EXPECT_TRUE(transforms.lookup("odom", "camera_link", world_.now()));
}

TEST_F(NodeTest, AClockSetBackClearsTheHistoryAndTellsTheComponent) {
  world_.add<Parrot>("parrot", {});
  Node& node = world_.node_of("parrot");
  const TransformBuffer& transforms = node.transforms();
  world_.tester().publish_transform("odom", "base_link", world_.now(), Pose2{1, 0, 0});
  world_.settle();
  ASSERT_TRUE(transforms.lookup("odom", "base_link", world_.now()));
  bool told = false;
  node.on_clock_jump([&] { told = true; });
  world_.set_time(time_from_seconds(1));
  node.handle_clock_jump();
  EXPECT_TRUE(told);
  EXPECT_EQ(transforms.lookup("odom", "base_link", time_from_seconds(1000)).error(),
            TransformError::kNotYet);
}

TEST_F(NodeTest, StreamsOfChanceAreNamedByComponentAndPurpose) {
  world_.add<Parrot>("parrot", {});
  world_.add<Parrot>("crow", {});
  RandomStream a = world_.node_of("parrot").random("noise");
  RandomStream b = world_.node_of("crow").random("noise");
  RandomStream again = world_.node_of("parrot").random("noise");
  const auto first = a();
  EXPECT_NE(first, b());
  EXPECT_EQ(first, again());
}

}  // namespace
}  // namespace coop::runtime
