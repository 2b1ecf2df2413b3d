#include "launcher/supervisor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <map>

namespace coop::launcher {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Writes down what the supervisor asks for.
class FakeHost : public ProcessHost {
 public:
  Result<pid_t> start(const PlannedComponent& component) override {
    calls.push_back("start " + component.name);
    if (unstartable.contains(component.name)) return fail("cannot execute");
    pids[component.name] = ++last_pid;
    names[last_pid] = component.name;
    return last_pid;
  }
  void signal(pid_t pid, int number) override {
    const char* text = number == SIGTERM ? "term " : "kill ";
    calls.push_back(text + names[pid]);
  }
  std::string last_words(const std::string&) const override { return words; }

  std::vector<std::string> take() { return std::exchange(calls, {}); }

  std::vector<std::string> calls;
  std::map<std::string, pid_t> pids;
  std::map<pid_t, std::string> names;
  std::set<std::string> unstartable;
  std::string words;
  pid_t last_pid = 100;
};

PlannedComponent component(const std::string& name, std::vector<std::size_t> after = {}) {
  PlannedComponent planned;
  planned.name = name;
  planned.after = std::move(after);
  planned.restart = {.policy = "on-failure",
                     .min_backoff = 0.1,
                     .max_backoff = 0.5,
                     .give_up_after = 4,
                     .within = 60.0};
  planned.start_timeout = 10.0;
  planned.heartbeat_timeout = 3.0;
  planned.stop_timeout = 2.0;
  return planned;
}

/// A supervisor on a clock that only the test moves.
class SupervisorTest : public ::testing::Test {
 protected:
  void make(std::vector<PlannedComponent> components) {
    plan_.components = std::move(components);
    supervisor_.emplace(plan_, host_, [this](const std::string& name, const std::string& text) {
      reports_.push_back(name + ": " + text);
    });
    supervisor_->start(now_);
  }
  void beat(const std::string& name, Health health = Health::kReady, std::string detail = "") {
    supervisor_->on_heartbeat({.component = name,
                               .health = health,
                               .detail = std::move(detail),
                               .pid = host_.pids[name],
                               .host = "here"},
                              now_);
  }
  void exits(const std::string& name, int code, int signal = 0) {
    supervisor_->on_exit(host_.pids[name], {.code = code, .signal = signal}, now_);
  }
  void advance(std::chrono::milliseconds time, const std::vector<std::string>& beating = {}) {
    const Instant end = now_ + time;
    while (now_ < end) {
      now_ = std::min<Instant>(end, now_ + 50ms);
      for (const std::string& name : beating) beat(name);
      supervisor_->tick(now_);
    }
  }
  State state(const std::string& name) {
    for (const auto& row : supervisor_->view()) {
      if (row.name == name) return row.state;
    }
    return State::kFailed;
  }

  Plan plan_;
  FakeHost host_;
  std::optional<Supervisor> supervisor_;
  std::vector<std::string> reports_;
  Instant now_{1000s};
};

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
  EXPECT_FALSE(supervisor_->all_up());
  beat("camera");
  beat("slam");
  EXPECT_TRUE(supervisor_->all_up());
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

TEST_F(SupervisorTest, TheNextDeadlineIsTheEarliestOfAll) {
  make({component("a"), component("b")});
  EXPECT_EQ(supervisor_->next_deadline(), now_ + 10s);
  beat("a");
  EXPECT_EQ(supervisor_->next_deadline(), now_ + 3s);
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
