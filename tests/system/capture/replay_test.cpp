// What was recorded is played into the programs it came from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "core/map/map_file.hpp"
#include "support/shared_data.hpp"
#include "system/capture/capture_support.hpp"

namespace coop::test {
namespace {

constexpr std::chrono::minutes kRunLimit{5};

/// Hashes of what a component wrote in lockstep, by topic and number.
std::map<std::string, std::string> trace_of(const std::filesystem::path& run,
                                            const std::string& component) {
  std::map<std::string, std::string> samples;
  std::ifstream file(run / "trace" / (component + ".trace"));
  std::string tick;
  std::string topic;
  std::string sequence;
  std::string hash;
  while (file >> tick >> topic >> sequence >> hash) samples[topic + " " + sequence] = hash;
  return samples;
}

const std::string kRecorded =
    "include: [" +
    (std::filesystem::path(COOP_SOURCE_DIR) / "config/launch/collect.yaml").string() +
    "]\n"
    "lockstep: true\n"
    "trace: true\n"
    "variables: {rate: 0}\n"
    "components:\n"
    "  record: {parameters: {exclude: [\"/camera/*\"]}}\n"
    "  simulator: {on_exit: shutdown, parameters: {duration: 15}}\n";

std::string replay_launch(const std::filesystem::path& capture) {
  return "use_sim_time: true\n"
         "lockstep: true\n"
         "trace: true\n"
         "components:\n"
         "  amcl:\n"
         "    parameters: {map_file: maps/duck_house_survey.yaml}\n"
         "  play:\n"
         "    time: system\n"
         "    on_exit: shutdown\n"
         "    parameters: {file: \"" +
         capture.string() + "\", rate: 0, topics: [/scan, /odom, /tf, /tf_static, /clock]}\n";
}

TEST(Replay, OfALockstepGivesAmclsOutputsToTheBit) {
  const LaunchText recorded(kRecorded);
  RunningSystem live(recorded.path());
  const auto status = live.launcher().wait(kRunLimit);
  ASSERT_TRUE(status && status->clean()) << live.launcher().output();
  const auto run = live.folder() / "runs/latest";
  const auto files = captures_of(run);
  ASSERT_EQ(files.size(), 1U);

  const LaunchText replayed(replay_launch(files[0]));
  RunningSystem again(replayed.path());
  const auto replay_status = again.launcher().wait(kRunLimit);
  ASSERT_TRUE(replay_status && replay_status->clean()) << again.launcher().output();
  const auto before = trace_of(run, "amcl");
  const auto after = trace_of(again.folder() / "runs/latest", "amcl");
  std::size_t compared = 0;
  for (const auto& [sample, hash] : before) {
    if (sample.starts_with("particle_cloud ")) continue;  // written while somebody listens
    const auto found = after.find(sample);
    ASSERT_NE(found, after.end()) << sample << " of " << before.size();
    EXPECT_EQ(found->second, hash) << sample;
    ++compared;
  }
  EXPECT_GT(compared, 200U);
}

/// Area of the cells that a map calls free, m2.
double free_area(const std::filesystem::path& yaml) {
  const auto map = map::load_map(yaml);
  const auto free = std::ranges::count(map.cells, kFree);
  return static_cast<double>(free) * map.geometry.resolution * map.geometry.resolution;
}

TEST(Replay, TheBagOfARealRobotBecomesAMap) {
  const auto bag = shared_data("ros2/bags/macfirst_floor_take_2");
  if (!bag) GTEST_SKIP() << "not run: no recorded bag";
  const TemporaryFolder folder;
  const auto capture = folder.path() / "bag.mcap";
  Program import("mcap", {"import", bag->string(), "-o", capture.string()}, folder.path() / "out");
  const auto imported = import.wait();
  ASSERT_TRUE(imported && imported->clean()) << import.output();
  const LaunchText launch(
      "use_sim_time: true\nlockstep: true\ncomponents:\n"
      "  slam:\n    stop_timeout: 60\n    parameters: {save_path: \"" +
      (folder.path() / "map").string() +
      "\", scan_timeout: 0, session: \"\"}\n"
      "  play: {time: system, on_exit: shutdown, parameters: {file: \"" +
      capture.string() + "\", rate: 0}}\n");
  RunningSystem system(launch.path());
  const auto status = system.launcher().wait(kRunLimit);
  ASSERT_TRUE(status && status->clean()) << system.launcher().output();
  EXPECT_GT(free_area(folder.path() / "map.yaml"), 20.0);
}

}  // namespace
}  // namespace coop::test
