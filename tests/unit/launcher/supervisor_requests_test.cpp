// Stopping, and what a person asks for.
#include "unit/launcher/supervisor_fixture.hpp"

namespace coop::launcher {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST_F(SupervisorTest, StoppingGoesInReverseAndWaitsForThoseThatComeAfter) {
  make({component("sim"), component("lidar", {0}), component("camera"), component("slam", {1})});
  for (const char* name : {"sim", "lidar", "camera", "slam"}) beat(name);
  host_.take();
  supervisor_->shut_down({kExitOk, "asked to"}, now_);
  EXPECT_THAT(host_.take(), ElementsAre("term slam", "term camera"));
  exits("camera", 0);
  EXPECT_THAT(host_.take(), ElementsAre("kill camera"));
  exits("slam", 0);
  EXPECT_THAT(host_.take(), ElementsAre("kill slam", "term lidar"));
  exits("lidar", 0);
  EXPECT_THAT(host_.take(), ElementsAre("kill lidar", "term sim"));
  exits("sim", 0);
  EXPECT_TRUE(supervisor_->done());
  EXPECT_EQ(supervisor_->outcome().code, 0);
}

TEST_F(SupervisorTest, EverythingGoesOnUntilTheBaseStands) {
  FakeBase base;
  make({component("base"), component("dwa", {0})}, &base);
  beat("base");
  beat("dwa");
  host_.take();
  supervisor_->shut_down({kExitGivenUp, "dwa given up"}, now_);
  EXPECT_EQ(base.halts, 1);
  advance(1s, {"base", "dwa"});
  EXPECT_THAT(host_.take(), IsEmpty());
  EXPECT_LE(supervisor_->next_deadline(), now_ + 50ms);
  base.now = Base::Motion::kAtRest;
  advance(50ms);
  EXPECT_THAT(host_.take(), IsEmpty()) << "it may have stood for a moment only";
  advance(100ms);
  EXPECT_THAT(host_.take(), ElementsAre("term dwa"));
  exits("dwa", 0);
  exits("base", 0);
  EXPECT_TRUE(supervisor_->done());
  EXPECT_EQ(supervisor_->outcome().code, kExitGivenUp);
}

TEST_F(SupervisorTest, ABaseThatDiesWhileItIsWaitedForIsNotStartedAgain) {
  FakeBase base;
  make({component("base"), component("dwa", {0})}, &base);
  beat("base");
  beat("dwa");
  supervisor_->shut_down({kExitOk, "asked to"}, now_);
  host_.take();
  exits("base", 0, SIGSEGV);
  base.now = Base::Motion::kUnknown;
  advance(500ms);
  EXPECT_THAT(host_.take(), ElementsAre("kill base", "term dwa"));
}

TEST_F(SupervisorTest, NobodyWaitsWhereThereIsNoBaseOrItDoesNotStop) {
  FakeBase base;
  base.now = Base::Motion::kNone;
  make({component("camera")}, &base);
  beat("camera");
  host_.take();
  supervisor_->shut_down({kExitOk, "asked to"}, now_);
  EXPECT_THAT(host_.take(), ElementsAre("term camera"));

  FakeBase runaway;
  make({component("dwa")}, &runaway);
  beat("dwa");
  host_.take();
  supervisor_->shut_down({kExitOk, "asked to"}, now_);
  advance(Supervisor::kHaltLimit - 100ms, {"dwa"});
  EXPECT_THAT(host_.take(), IsEmpty());
  advance(100ms, {"dwa"});
  EXPECT_THAT(host_.take(), ElementsAre("term dwa"));
  EXPECT_THAT(reports_.back(), HasSubstr("the base does not come to rest"));
}

TEST_F(SupervisorTest, WhoIgnoresSigtermIsKilledAtHisTimeLimit) {
  make({component("dwa")});
  beat("dwa");
  host_.take();
  supervisor_->shut_down({kExitOk, "asked to"}, now_);
  advance(1900ms);
  EXPECT_THAT(host_.take(), ElementsAre("term dwa"));
  advance(100ms);
  EXPECT_THAT(host_.take(), ElementsAre("kill dwa"));
  exits("dwa", 0, SIGKILL);
  EXPECT_TRUE(supervisor_->done());
  EXPECT_THAT(reports_.back(), HasSubstr("dwa: killed: still there 2.00 s after SIGTERM"));
}

TEST_F(SupervisorTest, NothingIsStartedWhileTheSystemStops) {
  make({component("sim"), component("dwa"), component("slam", {0})});
  beat("dwa");
  exits("dwa", 3);  // backing off
  supervisor_->shut_down({kExitOk, "asked to"}, now_);
  host_.take();
  beat("sim");
  advance(1s);
  EXPECT_THAT(host_.take(), IsEmpty());
  exits("sim", 5);
  EXPECT_TRUE(supervisor_->done());
  EXPECT_EQ(supervisor_->outcome().reason, "asked to");
}

TEST_F(SupervisorTest, ARestartOnRequestTouchesOnlyTheOneNamed) {
  make({component("sim"), component("dwa", {0})});
  beat("sim");
  beat("dwa");
  host_.take();
  ASSERT_TRUE(supervisor_->restart("sim", now_));
  EXPECT_THAT(host_.take(), ElementsAre("term sim"));
  exits("sim", 0);
  EXPECT_THAT(host_.take(), ElementsAre("kill sim", "start sim"));
  EXPECT_EQ(state("dwa"), State::kReady);
  const auto refused = supervisor_->restart("simm", now_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), "no component 'simm'; did you mean 'sim'?");
}

TEST_F(SupervisorTest, AComponentStoppedOnRequestStaysDownUntilStartedAgain) {
  make({component("dwa")});
  beat("dwa");
  ASSERT_TRUE(supervisor_->stop("dwa", now_));
  exits("dwa", 0);
  advance(10s);
  EXPECT_EQ(state("dwa"), State::kStopped);
  EXPECT_FALSE(supervisor_->shutting_down());
  host_.take();
  ASSERT_TRUE(supervisor_->start("dwa", now_));
  EXPECT_THAT(host_.take(), ElementsAre("start dwa"));
  const auto refused = supervisor_->start("dwa", now_);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), HasSubstr("runs already"));
}

TEST_F(SupervisorTest, ARestartOnRequestWhileBackingOffDoesNotWait) {
  make({component("dwa")});
  beat("dwa");
  exits("dwa", 3);
  host_.take();
  ASSERT_TRUE(supervisor_->restart("dwa", now_));
  EXPECT_THAT(host_.take(), ElementsAre("start dwa"));
  advance(1s);
  EXPECT_THAT(host_.take(), IsEmpty());
}

TEST_F(SupervisorTest, ACleanExitIsAnEndUnlessThePolicyIsAlways) {
  auto driver = component("driver");
  driver.restart.policy = "always";
  make({component("player"), driver});
  beat("player");
  beat("driver");
  exits("player", 0);
  EXPECT_EQ(state("player"), State::kFinished);
  exits("driver", 0);
  EXPECT_EQ(state("driver"), State::kBackingOff);
  EXPECT_FALSE(supervisor_->shutting_down());
}

TEST_F(SupervisorTest, TheEndOfOneMayEndTheSystem) {
  auto player = component("player");
  player.exit_ends_system = true;
  make({player, component("slam", {0})});
  beat("player");
  beat("slam");
  host_.take();
  exits("player", 0);
  EXPECT_THAT(host_.take(), Contains("term slam"));
  exits("slam", 0);
  EXPECT_TRUE(supervisor_->done());
  EXPECT_EQ(supervisor_->outcome().code, kExitOk);
  EXPECT_EQ(supervisor_->outcome().reason, "player has finished");
}

TEST_F(SupervisorTest, WhenAllHaveFinishedSoHasTheSystem) {
  make({component("a"), component("b")});
  exits("a", 0);
  EXPECT_FALSE(supervisor_->done());
  exits("b", 0);
  EXPECT_TRUE(supervisor_->done());
  EXPECT_EQ(supervisor_->outcome().code, kExitOk);
}

}  // namespace
}  // namespace coop::launcher
