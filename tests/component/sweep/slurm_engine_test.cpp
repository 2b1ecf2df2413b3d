// The engine against commands of the test's own, which answer as Slurm's do. With a real cluster:
// tests/system/sweep.
#include "sweep/node/slurm_engine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "component/sweep/small_sweep.hpp"

namespace coop::sweep {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Makes the tasks at once, one after the other, unless there is a file `idle`.
constexpr const char* kSbatch = R"sh(#!/bin/bash
cd "$(dirname "$0")"
echo "sbatch $*" >>calls
[ ! -e refusal ] || { cat refusal >&2; exit 1; }
echo x >>jobs
job=$(wc -l <jobs)
for word in "$@"; do
  case $word in
    --array=*) last=${word#*-*-*-} last=${last%%%*} ;;
    --output=*) log=${word#*=} ;;
  esac
done
if [ ! -e idle ]; then
  for i in $(seq 0 "$last"); do
    file=${log/\%A/$job}
    SLURM_ARRAY_TASK_ID=$i bash "${@: -1}" >"${file/\%a/$i}" 2>&1
  done
fi
echo "$job"
)sh";

/// `left`: jobs of an earlier call; `state`: what it says of the tasks; `mute`: how often it fails
/// before that.
constexpr const char* kSqueue = R"sh(#!/bin/bash
cd "$(dirname "$0")"
case $* in *--name=*) cat left 2>/dev/null; exit 0 ;; esac
if [ -s mute ]; then
  sed -i 1d mute
  echo 'slurm_load_jobs error: Unable to contact slurm controller (connect failure)' >&2
  exit 1
fi
cat state 2>/dev/null || { echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1; }
)sh";

constexpr const char* kScancel = R"sh(#!/bin/bash
cd "$(dirname "$0")"
echo "scancel $*" >>calls
rm -f state left
)sh";

/// Run N succeeds in its try number lives-N (1); in those before it, it dies without a result.
constexpr const char* kTask = R"sh(#!/bin/bash
cd "$1"
echo x >>"tries-$2"
if [ "$(wc -l <"tries-$2")" -lt "$(cat "lives-$2" 2>/dev/null || echo 1)" ]; then
  echo starting
  echo 'out of luck'
  exit 1
fi
mkdir -p "results/runs/000$2"
cp "result-$2" "results/runs/000$2/result.json"
)sh";

class SlurmEngineTest : public ::testing::Test {
 protected:
  SlurmEngineTest() : path_(std::getenv("PATH")) {
    program("sbatch", kSbatch);
    program("squeue", kSqueue);
    program("scancel", kScancel);
    program("task", kTask);
    for (const auto& run : small_.runs) {
      write("result-" + std::to_string(run.number), small_.result_of(run, true));
    }
    ::setenv("PATH", (small_.path("") / ":").string().append(path_).c_str(), 1);
  }
  ~SlurmEngineTest() override { ::setenv("PATH", path_.c_str(), 1); }

  void write(const std::string& name, const std::string& content) const {
    write_file_atomically(small_.path(name), content);
  }
  void program(const std::string& name, const std::string& content) const {
    write(name, content);
    fs::permissions(small_.path(name), fs::perms::owner_all);
  }
  [[nodiscard]] SlurmEngine engine() const {
    const std::string task = small_.path("task").string();
    return SlurmEngine({.task = {task, small_.path("").string()},
                        .side_by_side = {},
                        .pause = std::chrono::milliseconds(1)});
  }
  void make() const {
    engine().make(small_.sweep, small_.runs, [] { return true; });
  }
  [[nodiscard]] bool is_made(std::size_t run) const {
    return is_finished(small_.sweep.folder, small_.sweep.config, small_.runs[run]);
  }
  [[nodiscard]] RunResult result(std::size_t run) const {
    return result_from_json(read_file(result_file(small_.sweep.folder, small_.runs[run])));
  }
  [[nodiscard]] std::string calls() const { return read_file(small_.path("calls")); }
  [[nodiscard]] auto submissions() const {
    const std::string all = calls();
    return std::ranges::count(all, '\n');
  }

  SmallSweep small_;
  std::string path_;
};

TEST_F(SlurmEngineTest, EveryRunIsATaskOfOneArray) {
  make();
  for (const std::size_t run : {0U, 1U, 2U}) EXPECT_TRUE(is_made(run));
  EXPECT_EQ(submissions(), 1);
  EXPECT_THAT(calls(), HasSubstr("--array=0-2 "));
}

TEST_F(SlurmEngineTest, WhatIsLostIsSubmittedAgainAlone) {
  write("lives-2", "2");
  make();
  for (const std::size_t run : {0U, 1U, 2U}) EXPECT_TRUE(is_made(run));
  EXPECT_EQ(submissions(), 2);
  EXPECT_THAT(calls(), HasSubstr("--array=0-0 "));
}

TEST_F(SlurmEngineTest, WhatNeverSucceedsIsNamedWithItsLastWords) {
  write("lives-2", "99");
  write("state", "0 FAILED NonZeroExitCode\n");
  make();
  EXPECT_TRUE(is_made(0));
  EXPECT_TRUE(is_made(2));
  EXPECT_FALSE(result(1).success);
  EXPECT_EQ(result(1).problem,
            "no result in 3 tries; Slurm task 3_0: FAILED; its log ends with: out of luck");
}

TEST_F(SlurmEngineTest, ARunThatSaysItselfWhyItFailedKeepsItsWord) {
  small_.sweep.config.slurm.retries = 1;
  write("result-3", small_.result_of(small_.runs[2], false));
  make();
  EXPECT_EQ(submissions(), 2);
  EXPECT_EQ(result(2).problem, "died");
}

TEST_F(SlurmEngineTest, StoppedItCancelsItsJobAndWaitsForTheTasks) {
  write("idle", "");
  write("state", "0 RUNNING None\n1 PENDING Resources\n");
  SlurmEngine slurm = engine();
  std::string status;
  slurm.make(small_.sweep, small_.runs, [&] {
    status = slurm.status();
    return status.find("running") == std::string::npos;
  });
  EXPECT_EQ(status, "Slurm job 1: 1 running, 1 waiting (Resources)");
  EXPECT_THAT(calls(), HasSubstr("\nscancel 1\n"));
  EXPECT_FALSE(fs::exists(small_.path("state"))) << "the tasks are gone";
}

TEST_F(SlurmEngineTest, WhatAnEarlierCallLeftBehindIsCancelledFirst) {
  write("left", "41\n41\n");
  make();
  EXPECT_TRUE(calls().starts_with("scancel 41\nsbatch ")) << calls();
}

TEST_F(SlurmEngineTest, AControllerThatDoesNotAnswerIsWaitedFor) {
  write("idle", "");
  write("mute", "1\n2\n3\n");
  SlurmEngine slurm = engine();
  small_.sweep.config.slurm.retries = 0;
  bool has_said_so = false;
  slurm.make(small_.sweep, small_.runs, [&] {
    has_said_so |= slurm.status().find("Unable to contact") != std::string::npos;
    return true;
  });
  EXPECT_TRUE(has_said_so);
  EXPECT_THAT(result(0).problem, HasSubstr("no result in 1 try;"));
}

TEST_F(SlurmEngineTest, AJobThatIsRefusedEndsTheSweepInSlurmsWords) {
  write("refusal", "sbatch: error: invalid partition specified: barn\n");
  try {
    make();
    ADD_FAILURE() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "sbatch: error: invalid partition specified: barn");
  }
}

TEST_F(SlurmEngineTest, WithoutSlurmOneLineSaysSo) {
  ::setenv("PATH", "/nowhere", 1);
  try {
    (void)engine();
    ADD_FAILURE() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no program 'sbatch'"));
  }
}

}  // namespace
}  // namespace coop::sweep
