#include "sweep/slurm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "core/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace coop::sweep {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

ArrayJob job() {
  return {.name = "coop-sweep-1",
          .command = {"/bin/echo", "it's", "$HOME `id` \"x\"", "two\nlines", "--only"},
          .runs = {4, 7},
          .side_by_side = 3,
          .folder = "/results/100%/slurm",
          .working_folder = "/here"};
}

TEST(BatchScript, gives_each_task_its_run_and_the_shell_nothing_to_interpret) {
  const test::TemporaryFolder folder;
  const auto script = folder.path() / "script";
  write_file_atomically(script, batch_script(job()));
  ChildProcess task({"/usr/bin/env", "SLURM_ARRAY_TASK_ID=1", "bash", script.string()},
                    folder.path() / "out");
  ASSERT_EQ(task.wait(), 0);
  EXPECT_EQ(read_file(folder.path() / "out"), "it's $HOME `id` \"x\" two\nlines --only 7\n");
}

TEST(SbatchArguments, what_the_sweep_needs_comes_after_what_the_user_wants) {
  SweepConfig config;
  config.timeout = 1800;
  config.slurm.partition = "short";
  config.slurm.options = {"--mem=2G", "--array=9"};
  EXPECT_THAT(sbatch_arguments(job(), config, "/results/script"),
              ElementsAre("--mem=2G", "--array=9", "--time=32", "--partition=short",
                          "--array=0-1%3", "--parsable", "--job-name=coop-sweep-1", "--chdir=/here",
                          "--output=/results/100%%/slurm/task-%A_%a.log", "/results/script"));
}

TEST(SbatchArguments, without_a_number_of_jobs_the_cluster_decides) {
  SweepConfig config;
  config.slurm.time_limit = "1:00:00";
  ArrayJob all = job();
  all.side_by_side.reset();
  const auto arguments = sbatch_arguments(all, config, "script");
  EXPECT_THAT(arguments, Contains("--array=0-1"));
  EXPECT_THAT(arguments, Contains("--time=1:00:00"));
}

TEST(JobNumber, is_found_among_warnings_and_before_the_cluster) {
  EXPECT_EQ(job_number("4711\n"), "4711");
  EXPECT_EQ(job_number("sbatch: warning: 3 of them\n4711;barn\n"), "4711");
  EXPECT_EQ(job_number("sbatch: error: invalid partition specified: x\n"), std::nullopt);
}

TEST(ArrayState, counts_what_is_not_over) {
  const ArrayState state = array_state(
      "0 COMPLETED None\n1 RUNNING None\n2 COMPLETING None\n3 PENDING JobArrayTaskLimit\n"
      "4 FAILED NonZeroExitCode\nslurm_load_jobs error: no such thing\nN/A RUNNING None\n");
  EXPECT_EQ(state.tasks.size(), 5U);
  EXPECT_EQ(state.active(), 3);
  EXPECT_EQ(state.running(), 1);
  EXPECT_EQ(state.reason, "JobArrayTaskLimit");
  EXPECT_EQ(state.tasks.at(4), "FAILED");
}

TEST(ArrayState, a_reason_may_have_several_words) {
  EXPECT_EQ(array_state("0 PENDING launch failed requeued held\n").reason,
            "launch failed requeued held");
}

TEST(ArrayState, of_nothing_is_empty) {
  EXPECT_THAT(array_state("").tasks, IsEmpty());
}

TEST(JobName, tells_folders_apart) {
  EXPECT_EQ(job_name("/a/b"), job_name("/a/./b"));
  EXPECT_NE(job_name("/a/b"), job_name("/a/c"));
}

}  // namespace
}  // namespace coop::sweep
