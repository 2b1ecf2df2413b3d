// The bag of a real robot is played into slam and amcl.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/map/map_file.hpp"
#include "support/shared_data.hpp"
#include "system/capture/capture_support.hpp"

namespace coop::test {
namespace {

constexpr std::chrono::minutes kRunLimit{5};

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
