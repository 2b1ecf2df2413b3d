// What was recorded in lockstep is played into the programs it came from: they say the same again,
// to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "system/capture/capture_support.hpp"

namespace coop::test {
namespace {

/// Hashes of what a component wrote in lockstep, by topic.
using Hashes = std::vector<std::string>;
using Trace = std::map<std::string, Hashes>;

Trace trace_of(const std::filesystem::path& run, const std::string& component) {
  Trace samples;
  std::ifstream file(run / "trace" / (component + ".trace"));
  std::string tick;
  std::string topic;
  std::string sequence;
  std::string hash;
  while (file >> tick >> topic >> sequence >> hash) samples[topic].push_back(hash);
  return samples;
}

/// Written only while somebody listens, who may be found a sample earlier or later.
const std::set<std::string> kOnDemand{"particle_cloud", "local_costmap", "local_plan",
                                      "dwa_candidates"};
constexpr std::ptrdiff_t kFoundLater = 2;

/// Whether the samples from number `skip` on begin those of another run, or all go on with them.
bool begins(const Hashes& samples, std::ptrdiff_t skip, const Hashes& others) {
  const auto rest = std::ssize(samples) - skip;
  if (rest <= 0) return false;
  const auto common = std::min(rest, std::ssize(others));
  return std::equal(samples.begin() + skip, samples.begin() + skip + common, others.begin());
}

bool is_the_same(const std::string& topic, const Hashes& before, const Hashes& after) {
  if (!kOnDemand.contains(topic)) return before.size() <= after.size() && begins(before, 0, after);
  for (std::ptrdiff_t skip = 0; skip <= kFoundLater; ++skip) {
    if (begins(before, skip, after) || begins(after, skip, before)) return true;
  }
  return false;
}

/// The robot as it comes drives for some seconds of simulated time, recorded but for its pictures.
std::string recorded_launch(const std::string& launch_file) {
  return "include: [" +
         (std::filesystem::path(COOP_SOURCE_DIR) / "config/launch" / launch_file).string() +
         "]\nlockstep: true\ntrace: true\nvariables: {rate: 0}\n"
         "components:\n"
         "  record: {parameters: {last: 0, exclude: [\"/camera/*\"]}}\n"
         "  simulator: {on_exit: shutdown, parameters: {duration: 30}}\n";
}

/// All of it but what `component` wrote is played to it. A recorder listens as it did before: some
/// topics are written only while somebody does.
std::string replay_launch(const std::filesystem::path& capture, const std::string& component,
                          const std::string& parameters) {
  return "use_sim_time: true\nlockstep: true\ntrace: true\n"
         "components:\n"
         "  record: {}\n  " +
         component + ": {parameters: {" + parameters +
         "}}\n"
         "  play:\n"
         "    time: system\n"
         "    on_exit: shutdown\n"
         "    parameters: {file: \"" +
         capture.string() + "\", rate: 0}\n";
}

/// One run of the robot, recorded once for all that is played from it.
class LockstepReplay : public ::testing::Test {
 protected:
  static void record(const std::string& launch_file) {
    if (recorded_.contains(launch_file)) return;
    const LaunchText launch(recorded_launch(launch_file));
    auto live = std::make_unique<RunningSystem>(launch.path());
    const auto status = live->launcher().wait(kRunLimit);
    ASSERT_TRUE(status && status->clean()) << live->launcher().output();
    recorded_[launch_file] = std::move(live);
  }
  static void TearDownTestSuite() { recorded_.clear(); }

  /// Plays it into `component`; all that this one wrote then is what it wrote before: so many
  /// samples at least on each of the `topics`.
  static void expect_the_same(const std::string& launch_file, const std::string& component,
                              const std::string& parameters,
                              const std::map<std::string, std::size_t>& topics) {
    ASSERT_TRUE(recorded_.contains(launch_file));
    const auto run = recorded_.at(launch_file)->folder() / "runs/latest";
    const auto files = captures_of(run);
    ASSERT_EQ(files.size(), 1U);
    const LaunchText launch(replay_launch(files[0], component, parameters));
    RunningSystem again(launch.path());
    const auto status = again.launcher().wait(kRunLimit);
    ASSERT_TRUE(status && status->clean()) << again.launcher().output();
    const Trace before = trace_of(run, component);
    const Trace after = trace_of(again.folder() / "runs/latest", component);
    for (const auto& [topic, hashes] : before) {
      ASSERT_TRUE(after.contains(topic)) << topic;
      EXPECT_TRUE(is_the_same(topic, hashes, after.at(topic))) << topic;
    }
    for (const auto& [topic, least] : topics) {
      ASSERT_TRUE(before.contains(topic)) << topic;
      EXPECT_GE(std::min(before.at(topic).size(), after.at(topic).size()), least) << topic;
    }
  }

 private:
  static constexpr std::chrono::minutes kRunLimit{5};
  static inline std::map<std::string, std::unique_ptr<RunningSystem>> recorded_;
};

TEST_F(LockstepReplay, GivesAmclsOutputsToTheBit) {
  record("collect.yaml");
  expect_the_same("collect.yaml", "amcl", "map_file: maps/duck_house_survey.yaml",
                  {{"tf", 500}, {"amcl_pose", 200}, {"particle_cloud", 25}, {"map", 1}});
}

TEST_F(LockstepReplay, GivesDwasOutputsToTheBit) {
  record("collect.yaml");
  expect_the_same("collect.yaml", "dwa", "",
                  {{"cmd_vel", 500}, {"navigation_status", 50}, {"local_costmap", 100}});
}

TEST_F(LockstepReplay, GivesSlamsMapAndTransformsToTheBit) {
  record("survey.yaml");
  expect_the_same("survey.yaml", "slam", "", {{"tf", 500}, {"map", 25}});
}

}  // namespace
}  // namespace coop::test
