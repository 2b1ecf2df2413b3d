// The robot maps the duck house, and its mapper dies on the way.
#include <gtest/gtest.h>

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
}

}  // namespace
}  // namespace coop::test
