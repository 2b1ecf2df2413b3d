#include "runtime/lockstep/coordinator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "conversions/time.hpp"

namespace coop::runtime {
namespace {

using coop_msgs::msg::LockstepDone;
using coop_msgs::msg::LockstepJoin;
using coop_msgs::msg::LockstepMark;
using coop_msgs::msg::LockstepMember;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
namespace DoneKind = coop_msgs::msg::LockstepDone_Constants;
namespace EndpointKind = coop_msgs::msg::LockstepEndpoint_Constants;
using Phase = LockstepCoordinator::Phase;

constexpr std::uint64_t kEpoch = 7;

LockstepMember member(const std::string& name, std::vector<std::string> writes,
                      std::vector<std::string> reads, std::uint64_t incarnation = 1) {
  LockstepMember result;
  result.name(name);
  result.incarnation(incarnation);
  const auto add = [&](const std::string& topic, std::uint8_t kind) {
    coop_msgs::msg::LockstepEndpoint endpoint;
    endpoint.topic(topic);
    endpoint.kind(kind);
    result.endpoints().push_back(endpoint);
  };
  for (const std::string& topic : writes) add(topic, EndpointKind::WRITER);
  for (const std::string& topic : reads) add(topic, EndpointKind::READER);
  return result;
}

LockstepMark mark(std::uint32_t endpoint, std::uint64_t sequence) {
  LockstepMark result;
  result.endpoint(endpoint);
  result.sequence_number(sequence);
  return result;
}

/// world -> scan -> dwa -> cmd_vel -> world
class CoordinatorTest : public ::testing::Test {
 protected:
  void join(const LockstepMember& who, std::uint64_t epoch = kEpoch) {
    LockstepJoin message;
    message.epoch(epoch);
    message.member(who);
    book_.receive(message);
  }
  LockstepDone done(const std::string& name, std::uint8_t kind) {
    LockstepDone message;
    message.name(name);
    message.incarnation(1);
    message.epoch(kEpoch);
    message.round(book_.roster().round());
    message.tick(book_.tick());
    message.kind(kind);
    return message;
  }
  void settle_all() {
    for (const auto& who : book_.roster().members()) {
      LockstepDone settled = done(who.name(), DoneKind::SETTLED);
      settled.incarnation(who.incarnation());
      settled.has_next(true);  // at once
      book_.receive(settled);
    }
    ASSERT_TRUE(book_.is_settled());
    book_.begin_running();
  }
  void start() {
    join(lidar_);
    join(dwa_);
    (void)book_.begin_round(Time{});
    settle_all();
  }
  std::vector<std::string> tick() {
    now_ += std::chrono::milliseconds(10);
    std::vector<std::string> names;
    orders_ = book_.begin_tick(now_);
    for (const auto& order : orders_) names.push_back(order.member);
    return names;
  }
  /// Done with the tick; the next timer in `next`.
  void finish(const std::string& name, std::vector<LockstepMark> marks, Duration next) {
    LockstepDone message = done(name, DoneKind::DONE);
    message.marks(std::move(marks));
    message.has_next(true);
    message.next(conversions::to_msg(now_ + next));
    book_.receive(message);
  }

  const LockstepMember lidar_ = member("lidar", {"scan"}, {});
  const LockstepMember dwa_ = member("dwa", {"cmd_vel"}, {"scan"});
  LockstepCoordinator book_{member("world", {}, {"cmd_vel"}), {"dwa", "lidar"}, kEpoch};
  Time now_ = time_from_seconds(1.0);
  std::vector<LockstepCoordinator::Order> orders_;
};

TEST_F(CoordinatorTest, BeginsWhenAllExpectedMembersHaveJoined) {
  EXPECT_FALSE(book_.wants_round());
  join(lidar_);
  EXPECT_THAT(book_.waits_for(), ElementsAre("dwa"));
  EXPECT_FALSE(book_.wants_round());
  join(dwa_);
  EXPECT_TRUE(book_.wants_round());
  const auto& roster = book_.begin_round(Time{});
  ASSERT_EQ(roster.members().size(), 3U);
  EXPECT_EQ(roster.members()[0].name(), "dwa");
  EXPECT_EQ(roster.members()[2].name(), "world");
  EXPECT_EQ(book_.phase(), Phase::kSettling);
}

TEST_F(CoordinatorTest, JoinsOfAnotherMastersTimeAreNotHeard) {
  join(lidar_, kEpoch - 1);
  join(dwa_);
  EXPECT_FALSE(book_.wants_round());
}

TEST_F(CoordinatorTest, NoTickBeginsBeforeAllAreDone) {
  start();
  EXPECT_TRUE(book_.may_step());
  EXPECT_THAT(tick(), ElementsAre("dwa", "lidar"));
  EXPECT_FALSE(book_.may_step());
  finish("dwa", {}, std::chrono::seconds(1));
  EXPECT_THAT(book_.waits_for(), ElementsAre("lidar"));
  EXPECT_FALSE(book_.may_step());
  finish("lidar", {}, std::chrono::seconds(1));
  EXPECT_TRUE(book_.may_step());
}

TEST_F(CoordinatorTest, AMemberWithNothingToDoIsNotAsked) {
  start();
  tick();
  finish("dwa", {}, std::chrono::milliseconds(30));
  finish("lidar", {}, std::chrono::seconds(1));
  EXPECT_THAT(tick(), IsEmpty());
  EXPECT_THAT(tick(), IsEmpty());
  EXPECT_THAT(tick(), ElementsAre("dwa"));  // its timer
}

TEST_F(CoordinatorTest, WhoReadsASampleIsAskedWithItsNumber) {
  start();
  tick();
  finish("lidar", {mark(0, 4)}, std::chrono::seconds(1));
  finish("dwa", {}, std::chrono::seconds(1));
  EXPECT_THAT(tick(), ElementsAre("dwa"));
  ASSERT_EQ(orders_[0].tick.marks().size(), 1U);
  EXPECT_EQ(orders_[0].tick.marks()[0].member(), 1U);  // lidar
  EXPECT_EQ(orders_[0].tick.marks()[0].sequence_number(), 4U);
  EXPECT_THAT(book_.take_own_marks(), IsEmpty());
  finish("dwa", {mark(0, 9)}, std::chrono::seconds(1));
  ASSERT_EQ(book_.take_own_marks().size(), 1U);
}

TEST_F(CoordinatorTest, OneThatCameBackIsNotWaitedForButTakenIn) {
  start();
  tick();
  finish("lidar", {}, std::chrono::seconds(1));
  EXPECT_FALSE(book_.wants_round());
  join(member("dwa", {"cmd_vel"}, {"scan"}, 2));
  EXPECT_FALSE(book_.may_step());
  EXPECT_TRUE(book_.wants_round());
  EXPECT_EQ(book_.begin_round(now_).tick(), 1U);
  LockstepDone late = done("dwa", DoneKind::SETTLED);  // incarnation 1 is dead
  book_.receive(late);
  EXPECT_THAT(book_.waits_for(), ElementsAre("dwa", "lidar"));
  settle_all();
  EXPECT_THAT(tick(), ElementsAre("dwa", "lidar"));
}

TEST_F(CoordinatorTest, WhatWasWrittenBeforeARoundIsStillDelivered) {
  start();
  tick();
  finish("lidar", {mark(0, 4)}, std::chrono::seconds(1));
  finish("dwa", {}, std::chrono::seconds(1));
  join(member("arm", {"pick_result"}, {}));  // shifts everybody's place
  (void)book_.begin_round(now_);
  settle_all();
  tick();
  const auto order = std::ranges::find(orders_, "dwa", &LockstepCoordinator::Order::member);
  ASSERT_NE(order, orders_.end());
  ASSERT_EQ(order->tick.marks().size(), 1U);
  EXPECT_EQ(order->tick.marks()[0].member(), 2U);
}

TEST_F(CoordinatorTest, OthersGoOnWithoutOneThatLeaves) {
  start();
  tick();
  finish("lidar", {}, std::chrono::seconds(1));
  book_.receive(done("dwa", DoneKind::LEAVING));
  EXPECT_TRUE(book_.wants_round());
  EXPECT_EQ(book_.begin_round(now_).members().size(), 2U);
}

}  // namespace
}  // namespace coop::runtime
