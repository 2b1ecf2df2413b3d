// The robot maps the duck house, and its mapper dies on the way.
#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "slam/session_file.hpp"
#include "slam/trajectory_file.hpp"
#include "system/mission/mission_watch.hpp"
#include "system/support/running_system.hpp"

namespace coop::test {
namespace {

constexpr std::chrono::minutes kMissionLimit{10};

TEST(SurveyTest, TheSurveySurvivesTheDeathOfTheMapperAndLeavesAMap) {
  RunningSystem system(COOP_SOURCE_DIR "/config/launch/survey.yaml", {"--until", "mission-done"});
  MissionWatch watch(system.domain());
  ASSERT_TRUE(system.wait_until_ready()) << system.launcher().output();
  const auto folder = system.run_folder();
  ASSERT_TRUE(wait_until([&] {
    watch.look();
    return watch.mission().state() == coop_msgs::msg::MissionStatus_Constants::SEARCHING;
  }));
  ASSERT_TRUE(wait_until([&] {
    watch.look();
    return std::filesystem::exists(folder / "slam.session");
  })) << "no session was kept";
  const auto begun = slam::parse_session(read_file(folder / "slam.session"));
  ASSERT_TRUE(begun) << begun.error();
  const pid_t killed = system.kill_component("slam");
  ASSERT_TRUE(system.wait_for([&](const launcher::SystemView&) {
    const auto row = system.row("slam");
    return row && row->pid != 0 && row->pid != killed && row->state == "ready";
  })) << "slam did not come back";
  const auto status = system.launcher().wait(kMissionLimit);
  ASSERT_TRUE(status) << "the survey did not end";
  EXPECT_EQ(status->code, 0) << system.launcher().output();
  EXPECT_TRUE(std::filesystem::exists(folder / "map.pgm"));
  EXPECT_TRUE(std::filesystem::exists(folder / "map.yaml"));
  // The map at the end is that of the first mapper, drawn on: its way begins where that one began.
  const auto way =
      slam::parse_trajectory(read_file(folder / "map_trajectory.txt"), "map_trajectory.txt");
  ASSERT_FALSE(way.empty());
  EXPECT_LE(way.front().stamp, begun->nodes.front().stamp);
  EXPECT_LT(distance(way.front().pose, begun->nodes.front().base_in_map), 0.2);
}

}  // namespace
}  // namespace coop::test
