#include "arm_driver/pick_sequence.hpp"

#include <gtest/gtest.h>

#include "unit/arm_driver/bench_arm.hpp"

namespace coop::arm_driver {
namespace {

using namespace test;
using Phase = PickSequence::Phase;

TEST(PickSequence, PicksAnEggIntoTheBasketInSixToEightSeconds) {
  BenchArm bench;
  bench.order("p1");
  const double start = bench.time;
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[0], (PickReport{"p1", "egg", PickOutcome::kPicked, ""}));
  EXPECT_EQ(bench.eggs_in_basket, 1);
  EXPECT_GT(bench.time - start, 6.0);
  EXPECT_LT(bench.time - start, 8.0);
  EXPECT_LT((bench.arm().positions - bench.motion().home()).norm(), 0.03) << "told at home";
  bench.run_for(1.0);
  EXPECT_FALSE(bench.step().busy);
}

TEST(PickSequence, GoesThroughItsPhasesInOrder) {
  BenchArm bench;
  bench.order("p1");
  std::vector<Phase> phases;
  bench.run_until([&] {
    if (phases.empty() || phases.back() != bench.sequence().phase()) {
      phases.push_back(bench.sequence().phase());
    }
    return !bench.reports.empty();
  });
  EXPECT_EQ(phases, (std::vector<Phase>{Phase::kRecover, Phase::kApproach, Phase::kDescend,
                                        Phase::kGrip, Phase::kLift, Phase::kCarry, Phase::kLower,
                                        Phase::kRelease, Phase::kHome, Phase::kIdle}));
}

TEST(PickSequence, KeepsTheJointsWithinTheirLimitsOfPositionAndSpeed) {
  BenchArm bench;
  bench.order("p1");
  const auto& chain = bench.motion().chain();
  JointVector last = bench.arm().positions;
  while (bench.reports.empty() && bench.time < 130.0) {
    const JointVector target = bench.step().target;
    ASSERT_TRUE(chain.within_limits(target));
    const JointVector speed = (target - last).cwiseAbs() / BenchArm::kStep;
    ASSERT_TRUE((speed.array() <= chain.max_velocity().array() + 1e-6).all());
    last = target;
  }
  EXPECT_EQ(bench.reports.size(), 1U);
}

TEST(PickSequence, WithoutVacuumSearchesAroundAndFindsAnEggThatLiesBeside) {
  BenchArm bench;
  bench.order("p1");
  bench.egg += Eigen::Vector2d(-0.04, 0.01);
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kPicked);
  EXPECT_EQ(bench.eggs_in_basket, 1);
}

TEST(PickSequence, WhereNoEggLiesReportsNoVacuumWithThePumpOff) {
  BenchArm bench;
  bench.egg_exists = false;
  bench.order("p1");
  const double start = bench.time;
  int touches = 0;
  Phase last = Phase::kIdle;
  ASSERT_TRUE(bench.run_until([&] {
    const Phase phase = bench.sequence().phase();
    if (phase == Phase::kGrip && last != phase) ++touches;
    last = phase;
    return !bench.reports.empty();
  }));
  EXPECT_EQ(touches, 7);
  EXPECT_LT(bench.time - start, 20.0);
  EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kNoVacuum);
  EXPECT_FALSE(bench.arm().suction);
}

TEST(PickSequence, FarEggIsRefusedWithoutAMovement) {
  BenchArm bench;
  bench.orders.push_back({"far", "egg", Eigen::Vector2d(2.0, 0.0)});
  bench.run_for(0.5);
  ASSERT_EQ(bench.reports.size(), 1U);
  EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kOutOfReach);
  EXPECT_LT((bench.arm().positions - bench.motion().home()).norm(), 1e-9);
  EXPECT_FALSE(bench.step().busy);
}

TEST(PickSequence, OrderWithoutAPlaceIsAbortedForGood) {
  BenchArm bench;
  bench.orders.push_back({"p1", "egg", fail("no transform")});
  bench.run_for(0.5);
  bench.order("p1");
  bench.run_for(10.0);
  ASSERT_EQ(bench.reports.size(), 2U);
  EXPECT_EQ(bench.reports[0], (PickReport{"p1", "egg", PickOutcome::kAborted, "no transform"}));
  EXPECT_EQ(bench.reports[1], bench.reports[0]) << "the base may be driving by now";
  EXPECT_EQ(bench.taken, 0);
}

TEST(PickSequence, AnotherOrderWhileOneRunsIsBusyAndForgotten) {
  BenchArm bench;
  bench.order("p1");
  bench.run_to(Phase::kDescend);
  bench.order("p2");
  bench.step();
  ASSERT_EQ(bench.reports.size(), 1U);
  EXPECT_EQ(bench.reports[0].pick_id, "p2");
  EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kBusy);
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[1].outcome, PickOutcome::kPicked);
  EXPECT_FALSE(bench.sequence().knows("p2"));
}

TEST(PickSequence, SameOrderSaidAgainWhileItRunsJustGoesOn) {
  BenchArm bench;
  bench.order("p1");
  bench.run_to(Phase::kCarry);
  bench.order("p1");
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kPicked);
  bench.run_for(2.0);
  EXPECT_EQ(bench.reports.size(), 1U);
  EXPECT_EQ(bench.taken, 1);
}

TEST(PickSequence, SameOrderAfterItsEndRepeatsTheResultAndMovesNothing) {
  BenchArm bench;
  bench.order("p1");
  ASSERT_TRUE(bench.run_to_report());
  bench.egg_exists = true;  // another egg at the same place
  bench.order("p1");
  bench.run_for(10.0);
  ASSERT_EQ(bench.reports.size(), 2U);
  EXPECT_EQ(bench.reports[1], bench.reports[0]);
  EXPECT_EQ(bench.taken, 1);
}

TEST(PickSequence, EggThatFallsOnTheWayAborts) {
  BenchArm bench;
  bench.order("p1");
  bench.run_to(Phase::kCarry);
  bench.run_for(0.3);
  bench.held = bench.egg_exists = false;
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kAborted);
  EXPECT_FALSE(bench.arm().suction);
  EXPECT_LT((bench.arm().positions - bench.motion().home()).norm(), 0.03);
}

TEST(PickSequence, WithoutAReadingOfTheVacuumAborts) {
  BenchArm bench;
  bench.order("p1");
  bench.run_to(Phase::kDescend);
  bench.reading = false;
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kAborted);
  EXPECT_EQ(bench.reports[0].detail, "no reading of the vacuum");
}

TEST(PickSequence, ArmThatDoesNotFollowAborts) {
  BenchArm bench;
  bench.order("p1");
  bench.run_to(Phase::kDescend);
  bench.jammed = true;
  ASSERT_TRUE(bench.run_to_report(10.0));
  EXPECT_EQ(bench.reports[0].detail, "the arm does not follow");
  bench.jammed = false;
  bench.order("p2");
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[1].outcome, PickOutcome::kPicked);
}

class InPhase : public testing::TestWithParam<Phase> {};

TEST_P(InPhase, FreezesTheJointsAndThePickGoesOnAfterwards) {
  BenchArm bench;
  bench.order("p1");
  ASSERT_TRUE(bench.run_to(GetParam()));
  bench.run_for(0.1);
  bench.stop = true;
  bench.step();
  const JointVector frozen = bench.arm().positions;
  const bool suction = bench.arm().suction;
  bench.run_for(20.0);
  EXPECT_LT((bench.arm().positions - frozen).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(bench.arm().suction, suction);
  EXPECT_TRUE(bench.reports.empty());
  bench.stop = false;
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kPicked);
  EXPECT_EQ(bench.eggs_in_basket, 1);
}

TEST_P(InPhase, RestartLosesNeitherEggNorAnswer) {
  BenchArm bench;
  bench.order("p1");
  ASSERT_TRUE(bench.run_to(GetParam()));
  bench.run_for(0.1);
  bench.restart();
  bench.order("p1");
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[0].pick_id, "p1");
  EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kPicked) << bench.reports[0].detail;
  bench.run_for(1.0);
  EXPECT_EQ(bench.eggs_in_basket, 1);
  EXPECT_EQ(bench.taken, 1);
}

INSTANTIATE_TEST_SUITE_P(EveryPhase, InPhase,
                         testing::Values(Phase::kApproach, Phase::kDescend, Phase::kGrip,
                                         Phase::kLift, Phase::kCarry, Phase::kLower,
                                         Phase::kRelease, Phase::kHome),
                         [](const auto& phase) { return std::string(to_string(phase.param)); });

TEST(PickSequence, RestartAtEveryMomentOfAPickLeavesOneEggInTheBasketAndOneAnswer) {
  for (double moment = 0.0; moment < 8.4; moment += 0.3) {
    BenchArm bench;
    bench.order("p1");
    bench.run_for(moment);
    bench.restart();
    bench.order("p1");
    ASSERT_TRUE(bench.run_to_report()) << moment;
    EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kPicked) << moment;
    EXPECT_EQ(bench.eggs_in_basket, 1) << moment;
    EXPECT_EQ(bench.taken, 1) << moment;
  }
}

TEST(PickSequence, RestartWithAnEggInTheGripperFinishesWithoutBeingAsked) {
  BenchArm bench;
  bench.order("p1");
  ASSERT_TRUE(bench.run_to(Phase::kCarry));
  bench.restart();
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[0], (PickReport{"p1", "egg", PickOutcome::kPicked, ""}));
  EXPECT_EQ(bench.eggs_in_basket, 1);
}

TEST(PickSequence, RestartInMidApproachGoesHomeAndWaitsForTheOrder) {
  BenchArm bench;
  bench.order("p1");
  ASSERT_TRUE(bench.run_to(Phase::kDescend));
  bench.restart();
  bench.run_for(5.0);
  EXPECT_TRUE(bench.reports.empty());
  EXPECT_EQ(bench.sequence().phase(), Phase::kIdle);
  EXPECT_FALSE(bench.sequence().record().running);
}

TEST(PickSequence, EggLostWhileTheDriverWasAwayIsToldSo) {
  BenchArm bench;
  bench.order("p1");
  ASSERT_TRUE(bench.run_to(Phase::kCarry));
  bench.held = bench.egg_exists = false;
  bench.restart();
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kAborted);
}

TEST(PickSequence, EggOfAnUnknownPickGoesToTheBasketAndNothingIsTold) {
  BenchArm bench;
  bench.order("p1");
  ASSERT_TRUE(bench.run_to(Phase::kCarry));
  BenchArm other;
  // The record is lost, the egg and the posture are not.
  bench.restart();
  PickSequence forgetful({}, bench.motion());
  SimulatedArm arm(bench.motion().chain(), bench.arm().positions);
  Time now = time_from_seconds(1.0);
  arm.command(bench.arm().positions, true, now);
  bool held = true;
  std::size_t reports = 0;
  for (int i = 0; i < 500; ++i) {
    now += seconds(0.02);
    arm.hear_truth(held, now);
    const ArmReading reading = arm.read(now);
    const ArmOutputs& outputs =
        forgetful.step({reading.positions, reading.suction, reading.vacuum, false, {}}, now);
    arm.command(outputs.target, outputs.suction, now);
    held = held && outputs.suction;
    reports += outputs.reports.size();
  }
  EXPECT_FALSE(held);
  EXPECT_EQ(reports, 0U);
  EXPECT_EQ(forgetful.phase(), Phase::kIdle);
}

TEST(PickSequence, TimeSetBackInMidPickDoesNotStopIt) {
  BenchArm bench;
  bench.order("p1");
  ASSERT_TRUE(bench.run_to(Phase::kCarry));
  bench.run_for(0.5);
  bench.time = 5.0;
  ASSERT_TRUE(bench.run_to_report());
  EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kPicked);
}

TEST(PickSequence, ADriverThatWasStoppedForSecondsGoesOnWhereItWas) {
  for (const Phase phase : {Phase::kApproach, Phase::kLift, Phase::kCarry, Phase::kLower,
                            Phase::kRelease, Phase::kHome}) {
    BenchArm bench;
    bench.order("p1");
    ASSERT_TRUE(bench.run_to(phase));
    bench.run_for(0.1);
    bench.time += 9.0;
    ASSERT_TRUE(bench.run_to_report()) << to_string(phase);
    EXPECT_EQ(bench.reports[0].outcome, PickOutcome::kPicked)
        << to_string(phase) << ": " << bench.reports[0].detail;
    EXPECT_EQ(bench.eggs_in_basket, 1) << to_string(phase);
  }
}

}  // namespace
}  // namespace coop::arm_driver
