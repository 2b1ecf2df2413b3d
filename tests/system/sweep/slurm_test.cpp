// A sweep on a Slurm cluster: the rows are those of this machine, though a task is killed; stopped,
// nothing of it is left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "system/sweep/slurm_cluster.hpp"
#include "system/sweep/tiny_sweep.hpp"

namespace coop::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The process that makes a run in `results`; 0 where there is none.
pid_t task_of(const SlurmCluster& cluster, const fs::path& results, int run) {
  const std::string ending = "--only" + std::string(1, '\0') + std::to_string(run) + '\0';
  for (const pid_t pid : cluster.processes()) {
    const std::string command = read_file("/proc/" + std::to_string(pid) + "/cmdline");
    if (command.ends_with(ending) && command.find(results.string()) != std::string::npos) {
      return pid;
    }
  }
  return 0;
}

class SlurmSystem : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (SlurmCluster::obstacle().empty()) cluster_ = std::make_unique<SlurmCluster>();
  }
  static void TearDownTestSuite() {
    if (!cluster_) return;
    cluster_->stop();
    EXPECT_THAT(cluster_->processes(), IsEmpty());
    cluster_.reset();
  }
  void SetUp() override {
    if (!cluster_) GTEST_SKIP() << "not run: " << SlurmCluster::obstacle();
  }
  /// Once the system of that run is being brought up.
  [[nodiscard]] static pid_t wait_for_task(const fs::path& results, int run) {
    pid_t pid = 0;
    const fs::path log = results / "runs" / ("000" + std::to_string(run)) / "launcher.log";
    wait_until(
        [&] {
          pid = fs::exists(log) ? task_of(*cluster_, results, run) : 0;
          return pid != 0;
        },
        kSweepLimit);
    return pid;
  }

  static inline std::unique_ptr<SlurmCluster> cluster_;
  TinySweep tiny_;
};

TEST_F(SlurmSystem, AKilledTaskIsMadeAgainAndTheRowsAreThoseOfThisMachine) {
  const fs::path here = tiny_.path("here");
  auto local = tiny_.start(here);
  const auto made = local->wait(kSweepLimit);
  ASSERT_TRUE(made && made->clean()) << local->output();

  const fs::path there = tiny_.path("there");
  auto sweep = tiny_.start(there, {"--engine", "slurm", "--slurm-options=--nice=10"});
  const pid_t task = wait_for_task(there, 2);
  ASSERT_NE(task, 0) << sweep->output();
  ASSERT_EQ(::kill(task, SIGKILL), 0);
  const auto ended = sweep->wait(kSweepLimit);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->code, 0) << sweep->output();

  EXPECT_EQ(read_file(there / "all.csv"), read_file(here / "all.csv"));
  EXPECT_EQ(read_file(there / "points.csv"), read_file(here / "points.csv"));
  EXPECT_TRUE(fs::exists(there / "report.html"));
  const auto logs = std::ranges::count_if(fs::directory_iterator(there / "slurm"), [](auto& file) {
    return file.path().extension() == ".log";
  });
  EXPECT_EQ(logs, 3) << "two tasks, and one that took the place of the killed one";
}

TEST_F(SlurmSystem, StoppedTheJobIsCancelledAndNoTaskGoesOn) {
  const fs::path results = tiny_.path("results");
  auto sweep = tiny_.start(results, {"--engine", "slurm", "--jobs", "1"});
  const pid_t task = wait_for_task(results, 1);
  ASSERT_NE(task, 0) << sweep->output();
  sweep->signal(SIGINT);
  const auto ended = sweep->wait(kSweepLimit);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->code, 130) << sweep->output();
  EXPECT_THAT(sweep->output(), HasSubstr("cancelling Slurm job"));
  EXPECT_THAT(cluster_->queue(), IsEmpty());
  EXPECT_FALSE(is_alive(task));
  EXPECT_FALSE(fs::exists(results / "runs/0002")) << "it had not begun, and never will";
}

}  // namespace
}  // namespace coop::test
