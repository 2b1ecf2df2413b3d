#include "unit/launcher/supervisor_fixture.hpp"

namespace coop::launcher {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST_F(SupervisorTest, WhatComesAfterAnotherStartsWhenThatIsUp) {
  make({component("sim"), component("lidar", {0}), component("camera"), component("slam", {1})});
  EXPECT_THAT(host_.take(), ElementsAre("start sim", "start camera"));
  beat("sim", Health::kStarting);
  EXPECT_THAT(host_.take(), IsEmpty());
  beat("sim");
  EXPECT_THAT(host_.take(), ElementsAre("start lidar"));
  beat("lidar", Health::kDegraded, "no world");
  EXPECT_THAT(host_.take(), ElementsAre("start slam"));
  EXPECT_EQ(state("lidar"), State::kDegraded);
  beat("camera");
  beat("slam");
  EXPECT_FALSE(supervisor_->all_ready());
  beat("lidar");
  EXPECT_TRUE(supervisor_->all_ready());
}

TEST_F(SupervisorTest, AProgramWithoutHeartbeatIsReadyAsSoonAsItRuns) {
  auto server = component("server");
  server.sends_heartbeat = false;
  make({server, component("a", {0})});
  EXPECT_EQ(state("server"), State::kReady);
  EXPECT_THAT(host_.take(), ElementsAre("start server", "start a"));
  beat("a");
  advance(60s, {"a"});
  EXPECT_EQ(state("server"), State::kReady);
}

TEST_F(SupervisorTest, WhatDiesIsStartedAgainAfterAPauseThatDoubles) {
  make({component("dwa")});
  beat("dwa");
  host_.take();
  host_.words = "assertion failed";
  exits("dwa", 0, SIGSEGV);
  EXPECT_THAT(host_.take(), ElementsAre("kill dwa"));  // what is left of its group
  EXPECT_THAT(reports_.back(), HasSubstr("killed by signal 11 (Segmentation fault) (last line: "
                                         "assertion failed); started again in 0.10 s"));
  advance(50ms);
  EXPECT_THAT(host_.take(), IsEmpty());
  advance(50ms);
  EXPECT_THAT(host_.take(), ElementsAre("start dwa"));
  exits("dwa", 3);
  host_.take();
  advance(150ms);
  EXPECT_THAT(host_.take(), IsEmpty());
  EXPECT_EQ(state("dwa"), State::kBackingOff);
  advance(50ms);
  EXPECT_THAT(host_.take(), ElementsAre("start dwa"));
  EXPECT_EQ(supervisor_->view()[0].restarts, 2);
}

TEST_F(SupervisorTest, ACrashLoopIsGivenUpAndTheSystemStops) {
  make({component("sim"), component("dwa")});
  beat("sim");
  beat("dwa");
  for (int i = 0; i < 4; ++i) {
    EXPECT_FALSE(supervisor_->shutting_down());
    exits("dwa", 7);
    advance(600ms, {"sim"});
  }
  EXPECT_TRUE(supervisor_->shutting_down());
  EXPECT_EQ(supervisor_->outcome().code, kExitGivenUp);
  EXPECT_THAT(supervisor_->outcome().reason, HasSubstr("dwa given up: exit code 7, failure 4 in"));
  EXPECT_EQ(state("dwa"), State::kFailed);
  EXPECT_THAT(host_.take(), Contains("term sim"));
  EXPECT_FALSE(supervisor_->done());
  exits("sim", 0);
  EXPECT_TRUE(supervisor_->done());
}

TEST_F(SupervisorTest, FailuresLongAgoAreForgotten) {
  make({component("dwa")});
  for (int i = 0; i < 20; ++i) {
    beat("dwa");
    exits("dwa", 7);
    advance(21s, {"dwa"});
    ASSERT_FALSE(supervisor_->shutting_down());
  }
  EXPECT_EQ(supervisor_->view()[0].restarts, 20);
}

TEST_F(SupervisorTest, WithoutTheOneThatIsNotRequiredTheRestGoesOn) {
  auto camera = component("camera");
  camera.required = false;
  camera.restart.policy = "never";
  make({camera, component("dwa", {0})});
  exits("camera", 9);
  EXPECT_EQ(state("camera"), State::kFailed);
  EXPECT_FALSE(supervisor_->shutting_down());
  EXPECT_THAT(host_.take(), Contains("start dwa"));
}

TEST_F(SupervisorTest, ABadConfigurationIsNotTriedAgain) {
  make({component("dwa")});
  host_.words = "dwa.yaml:3: unknown key";
  exits("dwa", 1);
  EXPECT_TRUE(supervisor_->done());
  EXPECT_EQ(supervisor_->outcome().reason,
            "dwa given up: exit code 1 (last line: dwa.yaml:3: unknown key)");
}

TEST_F(SupervisorTest, AProgramThatCannotBeExecutedEndsTheSystem) {
  host_.unstartable.insert("dwa");
  make({component("dwa")});
  EXPECT_TRUE(supervisor_->done());
  EXPECT_THAT(supervisor_->outcome().reason, HasSubstr("cannot execute"));
}

TEST_F(SupervisorTest, WhoIsNotReadyInTimeIsKilledAndStartedAgain) {
  make({component("slam")});
  beat("slam", Health::kStarting, "reads the map");
  advance(9900ms);
  EXPECT_THAT(host_.take(), ElementsAre("start slam"));
  advance(100ms);
  EXPECT_THAT(host_.take(), ElementsAre("kill slam"));
  advance(1s);
  EXPECT_THAT(host_.take(), IsEmpty());  // killed once
  exits("slam", 0, SIGKILL);
  EXPECT_THAT(reports_.back(), HasSubstr("not ready within 10 s: reads the map; started again"));
}

TEST_F(SupervisorTest, WhoseHeartbeatStopsIsKilledAndStartedAgain) {
  make({component("amcl")});
  beat("amcl");
  advance(10s, {"amcl"});
  EXPECT_EQ(state("amcl"), State::kReady);
  host_.take();
  advance(2900ms);
  EXPECT_THAT(host_.take(), IsEmpty());
  advance(100ms);
  EXPECT_THAT(host_.take(), ElementsAre("kill amcl"));
  exits("amcl", 0, SIGKILL);
  EXPECT_THAT(reports_.back(), HasSubstr("hangs: no heartbeat for 3.00 s; started again"));
  advance(200ms);
  EXPECT_THAT(host_.take(), Contains("start amcl"));
}

TEST_F(SupervisorTest, ASecondWithoutHeartbeatIsToldLongBeforeAnythingIsKilled) {
  make({component("amcl")});
  beat("amcl");
  host_.take();
  advance(950ms);
  EXPECT_EQ(state("amcl"), State::kReady);
  advance(50ms);
  EXPECT_EQ(state("amcl"), State::kSilent);
  EXPECT_EQ(reports_.back(), "amcl: silent: no heartbeat for 1.00 s");
  EXPECT_FALSE(supervisor_->all_ready());
  EXPECT_THAT(host_.take(), IsEmpty());
  beat("amcl", Health::kDegraded, "no scan");
  EXPECT_EQ(state("amcl"), State::kDegraded);
  advance(5s, {"amcl"});
  EXPECT_EQ(state("amcl"), State::kReady);
  EXPECT_THAT(host_.take(), IsEmpty());
}

TEST_F(SupervisorTest, WhoIsKeptFromRunningByTheLoadOfTheMachineHasMoreTime) {
  make({component("amcl")});
  beat("amcl");
  host_.take();
  host_.starved_for = 20.0;  // before it fell silent
  advance(1s);
  ASSERT_EQ(state("amcl"), State::kSilent);
  for (int i = 0; i < 75; ++i) {  // until 8.5 s
    host_.starved_for = *host_.starved_for + 0.06;
    advance(100ms);
  }
  EXPECT_THAT(host_.take(), IsEmpty());
  advance(500ms);
  EXPECT_THAT(host_.take(), ElementsAre("kill amcl")) << "three times its timeout is enough";
}

TEST_F(SupervisorTest, WhoSleepsOnALoadedMachineIsNotExcused) {
  make({component("amcl")});
  beat("amcl");
  host_.take();
  host_.starved_for = 20.0;
  advance(3s);
  EXPECT_THAT(host_.take(), ElementsAre("kill amcl"));
}

TEST_F(SupervisorTest, NobodyIsBlamedForTheTimeTheLauncherItselfDidNotRun) {
  make({component("amcl")});
  beat("amcl");
  host_.take();
  now_ += 1h;  // the machine slept
  supervisor_->tick(now_);
  EXPECT_THAT(host_.take(), IsEmpty());
  advance(3s);
  EXPECT_THAT(host_.take(), ElementsAre("kill amcl"));
}

TEST_F(SupervisorTest, ALateHeartbeatOfADeadProcessDoesNotCountForItsSuccessor) {
  make({component("amcl")});
  const pid_t old_pid = host_.pids["amcl"];
  beat("amcl");
  exits("amcl", 0, SIGKILL);
  advance(200ms);
  supervisor_->on_heartbeat(
      {.component = "amcl", .health = Health::kReady, .detail = "", .pid = old_pid, .host = ""},
      now_);
  EXPECT_EQ(state("amcl"), State::kStarting);
  EXPECT_THAT(reports_, Not(Contains(HasSubstr("another one"))));
}

TEST_F(SupervisorTest, AStrangerOfTheSameNameIsReportedOnce) {
  make({component("amcl")});
  const Heartbeat stranger{
      .component = "amcl", .health = Health::kReady, .detail = "", .pid = 7, .host = "barn"};
  supervisor_->on_heartbeat(stranger, now_);
  supervisor_->on_heartbeat(stranger, now_);
  EXPECT_EQ(std::ranges::count(reports_, "amcl: another one runs on this domain, pid 7 on barn"),
            1);
  EXPECT_EQ(state("amcl"), State::kStarting);
}

TEST_F(SupervisorTest, TheNextDeadlineIsTheEarliestOfAll) {
  make({component("a"), component("b")});
  EXPECT_EQ(supervisor_->next_deadline(), now_ + 10s);
  beat("a");
  EXPECT_EQ(supervisor_->next_deadline(), now_ + Supervisor::kSilence);
  exits("b", 4);
  EXPECT_EQ(supervisor_->next_deadline(), now_ + 100ms);
}

TEST_F(SupervisorTest, DegradedIsReportedWithItsReasonAndSoIsRecovery) {
  make({component("dwa")});
  beat("dwa");
  beat("dwa", Health::kDegraded, "no scan for 0.5 s");
  EXPECT_EQ(reports_.back(), "dwa: degraded: no scan for 0.5 s");
  const std::size_t count = reports_.size();
  beat("dwa", Health::kDegraded, "no scan for 0.5 s");
  EXPECT_EQ(reports_.size(), count);
  beat("dwa");
  EXPECT_EQ(reports_.back(), "dwa: ready");
}

}  // namespace
}  // namespace coop::launcher
