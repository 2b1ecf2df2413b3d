#include "experiments/chaos/judge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace coop::chaos {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Fifty times a second for three seconds, at a speed that depends on the time.
template <class SpeedAt>
std::vector<Motion> drive_at(const SpeedAt& speed_at) {
  std::vector<Motion> motion;
  double distance = 0.0;
  for (int i = 0; i < 150; ++i) {
    const double time = 0.02 * i;
    distance += 0.02 * speed_at(time);
    motion.push_back({time, distance});
  }
  return motion;
}

/// 0.5 m/s, and from `brakes` s on slower by 0.8 m/s2.
std::vector<Motion> drive(double brakes) {
  return drive_at(
      [brakes](double time) { return std::max(0.0, 0.5 - 0.8 * std::max(0.0, time - brakes)); });
}

TEST(JudgeStopping, WhoBrakesInTimeIsSafe) {
  const Stopping stopping = judge_stopping(drive(1.3), 1.0, 3.0, 0.05);
  EXPECT_TRUE(stopping.was_moving);
  EXPECT_TRUE(stopping.is_safe);
}

TEST(JudgeStopping, WhoDrivesOnIsNot) {
  EXPECT_FALSE(judge_stopping(drive(2.5), 1.0, 3.0, 0.05).is_safe);
}

TEST(JudgeStopping, WhoBrakesAndDrivesOffAgainBeforeItIsBackIsNot) {
  const std::vector<Motion> motion = drive_at([](double time) {
    return time > 2.4 ? 0.3 : std::max(0.0, 0.5 - 0.8 * std::max(0.0, time - 1.2));
  });
  const Stopping stopping = judge_stopping(motion, 1.0, 3.0, 0.05);
  EXPECT_FALSE(stopping.is_safe);
  EXPECT_NEAR(stopping.begun_after, 1.42, 0.07);
  EXPECT_TRUE(judge_stopping(motion, 1.0, 2.3, 0.05).is_safe) << "it was back by then";
}

TEST(JudgeStopping, SlippingWheelsAreNoSpeed) {
  RandomStream random(1, "judge_test");
  int unsafe = 0;
  for (int run = 0; run < 1000; ++run) {
    std::vector<Motion> motion = drive(1.35);
    double slipped = 0.0;  // as the simulator's wheels do
    for (std::size_t i = 1; i < motion.size(); ++i) {
      const double rolled = motion[i].distance - motion[i - 1].distance;
      slipped += 0.004 * std::sqrt(0.5 * rolled) * random.normal();
      motion[i - 1].distance += slipped;
    }
    motion.pop_back();
    if (!judge_stopping(motion, 1.0, 2.9, 0.05).is_safe) ++unsafe;
  }
  EXPECT_EQ(unsafe, 0) << "of 1000";
}

TEST(JudgeStopping, WhoGoesOnToSpeedUpIsNot) {
  const auto motion = drive_at([](double time) {
    return time < 1.55 ? 0.3 * time : std::max(0.0, 0.465 - 0.8 * (time - 1.55));
  });
  EXPECT_FALSE(judge_stopping(motion, 1.0, 2.9, 0.04).is_safe) << "0.21 s too late at 0.3 m/s2";
}

TEST(JudgeStopping, AShortLossAsksForNothing) {
  EXPECT_TRUE(judge_stopping(drive(9.0), 1.0, 1.3, 0.05).is_safe);
}

TEST(JudgeStopping, AStandingRobotHasNothingToDo) {
  const Stopping stopping = judge_stopping(drive(0.0), 2.0, 3.0, 0.05);
  EXPECT_FALSE(stopping.was_moving);
  EXPECT_TRUE(stopping.is_safe);
}

class JudgeEggs : public ::testing::Test {
 protected:
  void mission_egg(const std::string& id, double x, std::uint8_t state) {
    coop_msgs::msg::EggStatus egg;
    egg.egg_id(id);
    egg.position().x(x);
    egg.state(state);
    mission_.eggs().push_back(egg);
  }
  void true_egg(std::uint8_t state) {
    coop_msgs::msg::SimEgg egg;
    egg.state(state);
    truth_.eggs().push_back(egg);
  }
  static constexpr std::uint8_t kPicked = coop_msgs::msg::EggStatus_Constants::PICKED;
  static constexpr std::uint8_t kFailed = coop_msgs::msg::EggStatus_Constants::FAILED;
  static constexpr std::uint8_t kCollected = coop_msgs::msg::SimEgg_Constants::COLLECTED;
  coop_msgs::msg::MissionStatus mission_;
  coop_msgs::msg::GroundTruth truth_;
};

TEST_F(JudgeEggs, WhatIsCountedIsInTheBasket) {
  mission_egg("egg_1", 1.0, kPicked);
  mission_egg("egg_2", 2.0, kFailed);
  true_egg(kCollected);
  true_egg(coop_msgs::msg::SimEgg_Constants::ON_FLOOR);
  EXPECT_THAT(judge_eggs(mission_, truth_), IsEmpty());
}

TEST_F(JudgeEggs, AnEggThatIsLostOrCountedTwiceIsFound) {
  mission_egg("egg_1", 1.0, kPicked);
  EXPECT_THAT(judge_eggs(mission_, truth_),
              ElementsAre(HasSubstr("counts 1 eggs, in the basket are 0")));
  true_egg(kCollected);
  true_egg(kCollected);
  mission_egg("egg_2", 1.05, kPicked);
  EXPECT_THAT(judge_eggs(mission_, truth_), ElementsAre("one egg picked as two: egg_1"));
  mission_egg("egg_2", 3.0, kFailed);
  true_egg(coop_msgs::msg::SimEgg_Constants::BROKEN);
  EXPECT_THAT(judge_eggs(mission_, truth_),
              ElementsAre("1 eggs broken", "egg egg_2 twice", HasSubstr("picked as two")));
}

}  // namespace
}  // namespace coop::chaos
