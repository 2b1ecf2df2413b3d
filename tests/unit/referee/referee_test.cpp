#include "referee/referee.hpp"

#include <gtest/gtest.h>

#include "core/csv.hpp"

namespace coop::referee {
namespace {

using Phase = MissionEgg::Phase;
using Source = NavigationView::Source;
using State = NavigationView::State;

/// A mission in a world with two eggs, told to a referee moment by moment. The map's origin is the
/// start at (1, 1) in world, looking along x.
class RefereeTest : public ::testing::Test {
 protected:
  RefereeTest() : referee_(RefereeConfig{}, {0.92, 0.0}) {
    world_.robot_start = {1.0, 1.0, 0.0};
    world_.eggs = {{"near", {4.0, 1.0, 0.02}}, {"far", {9.0, 5.0, 0.02}}};
    truth_.eggs = world_.eggs;
    truth_.stamp = time_from_seconds(1.0);
    referee_.begin(world_);
    stand_at({1.0, 1.0, 0.0});
  }

  void stand_at(const Pose2& robot_in_world) {
    truth_.stamp += seconds(1.0);
    truth_.robot_in_world = robot_in_world;
    referee_.see(truth_);
    const Pose2 in_map = world_.robot_start.inverse() * robot_in_world;
    referee_.locate(truth_.stamp, robot_in_world, in_map);
  }
  void tell(Phase phase, int tries, const std::string& reason = "",
            const Eigen::Vector2d& egg_in_map = {3.0, 0.0}) {
    referee_.hear(MissionView{.ended = false,
                              .eggs = {{.id = "egg1",
                                        .phase = phase,
                                        .tries = tries,
                                        .reason = reason,
                                        .egg_in_map = egg_in_map}}});
  }
  void set_out() {
    referee_.hear_goal("7");
    tell(Phase::kApproaching, 1);
  }
  void navigate(Source source, State state) { referee_.hear(NavigationView{source, state, "7"}); }

  Attempt only() {
    const auto finished = referee_.take_finished();
    EXPECT_EQ(finished.size(), 1U);
    return finished.empty() ? Attempt{} : finished.front();
  }

  world::World world_;
  world::GroundTruth truth_;
  Referee referee_;
};

TEST_F(RefereeTest, AnArrivalBeforeTheEggAndAPickAreASuccess) {
  set_out();
  stand_at({2.0, 1.0, 0.0});
  stand_at({3.08, 1.0, 0.0});
  navigate(Source::kDriver, State::kArrived);
  stand_at({3.08, 1.0, 0.0});
  tell(Phase::kPicking, 1);
  truth_.eggs[0].state = world::EggState::kCollected;
  stand_at({3.08, 1.0, 0.0});
  tell(Phase::kOver, 1);
  const Attempt attempt = only();
  EXPECT_EQ(attempt.egg, "near");
  EXPECT_TRUE(attempt.in_range);
  EXPECT_TRUE(attempt.picked);
  EXPECT_NEAR(attempt.path_length, 2.08, 1e-9);
  ASSERT_TRUE(attempt.arrival);
  EXPECT_NEAR(attempt.arrival->deviation.norm(), 0.0, 1e-9);
  EXPECT_EQ(attempt.cause, Cause::kNone);
}

TEST_F(RefereeTest, AnArrivalIsJudgedOnlyWhenTheRobotStands) {
  set_out();
  truth_.velocity.v = 0.1;
  stand_at({2.9, 1.0, 0.0});
  navigate(Source::kDriver, State::kArrived);
  stand_at({3.0, 1.0, 0.0});
  truth_.velocity.v = 0.0;
  stand_at({3.08, 1.0, 0.0});
  tell(Phase::kWaiting, 1, "egg out of reach");
  const Attempt attempt = only();
  ASSERT_TRUE(attempt.arrival);
  EXPECT_NEAR(attempt.arrival->deviation.norm(), 0.0, 1e-9);
}

TEST_F(RefereeTest, ARobotFarFromTheEggOnArrivalMissedIt) {
  set_out();
  stand_at({2.8, 1.0, 0.0});
  navigate(Source::kDriver, State::kArrived);
  stand_at({2.8, 1.0, 0.0});
  tell(Phase::kOver, 1, "out of reach");
  const Attempt attempt = only();
  EXPECT_FALSE(attempt.in_range);
  EXPECT_EQ(attempt.cause, Cause::kControlError);
  EXPECT_EQ(attempt.detail, "out of reach");
}

TEST_F(RefereeTest, WhoGaveTheGoalUpIsNamed) {
  set_out();
  navigate(Source::kPlanner, State::kFailed);
  tell(Phase::kOver, 1, "no path");
  EXPECT_EQ(only().cause, Cause::kNoPath);
}

TEST_F(RefereeTest, AnotherSideOfTheEggAfterARefusalIsTheSameAttempt) {
  set_out();
  navigate(Source::kPlanner, State::kFailed);
  referee_.hear_goal("8");
  tell(Phase::kApproaching, 1);
  EXPECT_TRUE(referee_.take_finished().empty());
  navigate(Source::kPlanner, State::kFailed);  // of goal 7, told late
  tell(Phase::kOver, 1, "not there after 150 s");
  EXPECT_EQ(only().cause, Cause::kTimedOut);
}

TEST_F(RefereeTest, ADriverThatOnlyWaitedDidNotGiveUp) {
  set_out();
  navigate(Source::kDriver, State::kFailed);
  navigate(Source::kDriver, State::kUnderWay);
  tell(Phase::kOver, 1, "not there after 150 s");
  EXPECT_EQ(only().cause, Cause::kTimedOut);
}

TEST_F(RefereeTest, ACollisionOnTheWayIsTheCauseWhereTheRobotDidNotArrive) {
  set_out();
  truth_.collision_count = 2;
  stand_at({2.0, 1.0, 0.0});
  navigate(Source::kDriver, State::kFailed);
  tell(Phase::kOver, 1, "stuck");
  const Attempt attempt = only();
  EXPECT_EQ(attempt.cause, Cause::kCollision);
  EXPECT_EQ(attempt.collisions, 2U);
}

TEST_F(RefereeTest, AnEggWithoutAFreePoseIsAnAttemptWithoutAGoal) {
  referee_.hear_goal("6");
  tell(Phase::kOver, 1, "no free pose around the egg");
  EXPECT_EQ(only().cause, Cause::kNoFreePose);
}

TEST_F(RefereeTest, AnEggThatIsNotThereIsFalse) {
  referee_.hear_goal("7");
  tell(Phase::kApproaching, 1, "", {3.0, 2.0});
  tell(Phase::kOver, 1, "not seen", {3.0, 2.0});
  const Attempt attempt = only();
  EXPECT_EQ(attempt.cause, Cause::kFalseEgg);
  EXPECT_EQ(attempt.egg, "");
}

TEST_F(RefereeTest, AnEggUnderAWheelIsBroken) {
  set_out();
  truth_.eggs[0].state = world::EggState::kBroken;
  stand_at({3.5, 1.0, 0.0});
  navigate(Source::kDriver, State::kArrived);
  tell(Phase::kOver, 1, "");
  EXPECT_EQ(only().cause, Cause::kEggBroken);
}

TEST_F(RefereeTest, EachTryIsAnAttempt) {
  set_out();
  tell(Phase::kWaiting, 1, "no path");
  referee_.hear_goal("8");
  tell(Phase::kApproaching, 2);
  tell(Phase::kOver, 2, "no path");
  const auto finished = referee_.take_finished();
  ASSERT_EQ(finished.size(), 2U);
  EXPECT_EQ(finished[0].try_number, 1);
  EXPECT_EQ(finished[1].try_number, 2);
}

TEST_F(RefereeTest, TheEndAccountsForEveryEgg) {
  set_out();
  referee_.end();
  const auto finished = referee_.take_finished();
  ASSERT_EQ(finished.size(), 2U);
  EXPECT_EQ(finished[0].cause, Cause::kMissionEnded);
  EXPECT_EQ(finished[1].egg, "far");
  EXPECT_EQ(finished[1].cause, Cause::kNotSeen);
  EXPECT_EQ(finished[1].try_number, 0);
}

TEST_F(RefereeTest, AKnownEggThatNobodyDroveToWasNotTried) {
  tell(Phase::kWaiting, 0);
  referee_.end();
  const auto finished = referee_.take_finished();
  ASSERT_EQ(finished.size(), 2U);
  EXPECT_EQ(finished[0].cause, Cause::kNotTried);
  EXPECT_EQ(finished[0].mission_egg, "egg1");
}

TEST(AttemptRow, has_a_field_for_each_column) {
  Attempt attempt;
  attempt.detail = "dwa: stuck, \"for good\"";
  EXPECT_EQ(to_row(attempt, 1, 1).size(), attempt_columns().size());
  attempt.arrival.emplace();
  const auto row = to_row(attempt, 1, 1);
  ASSERT_EQ(row.size(), attempt_columns().size());
  const CsvTable table = parse_csv(csv_line(attempt_columns()) + csv_line(row));
  EXPECT_EQ(table.rows.at(0), row);
}

}  // namespace
}  // namespace coop::referee
