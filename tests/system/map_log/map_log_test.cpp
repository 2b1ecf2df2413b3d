// A recorded log becomes a map, undisturbed and with players that die on the way.
#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "slam/trajectory_file.hpp"
#include "system/map_log/log_watch.hpp"
#include "system/map_log/recorded_drive.hpp"
#include "system/support/running_system.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

constexpr std::chrono::minutes kMapLimit{2};

class MapLogSystem : public ::testing::Test {
 protected:
  /// Plays the log at `rate` into a map; `disturb` runs meanwhile.
  void map(const std::string& name, double rate,
           const std::function<void(RunningSystem&)>& disturb) {
    watch_.emplace(test_domain());
    // Those who listen: slam and the watch.
    RunningSystem system(COOP_SOURCE_DIR "/config/launch/map_log.yaml",
                         {"--set", "log=" + drive_.file.string(), "--set",
                          "output=" + (folder_.path() / name).string(), "--set",
                          "chassis_driver.log.playback.rate=" + std::to_string(rate), "--set",
                          "chassis_driver.log.readers=2", "--set", "lidar_driver.log.readers=2"});
    disturb(system);
    std::optional<launcher::ExitStatus> status;
    ASSERT_TRUE(wait([&] {
      return (status = system.launcher().wait(milliseconds(0))).has_value();
    })) << "the log did not come to its end";
    EXPECT_EQ(status->code, 0) << system.launcher().output();
    expect_all_was_told();
  }
  bool wait(const std::function<bool()>& condition) {
    return look_until(*watch_, condition, kMapLimit);
  }
  bool wait_for_scans(std::size_t count) {
    return wait([&] { return watch_->scans().size() >= count; });
  }
  void expect_all_was_told() {
    EXPECT_EQ(watch_->odometry().size(), drive_.odometry.size());
    EXPECT_EQ(watch_->scans().size(), drive_.scans.size());
    EXPECT_TRUE(watch_->odometry() == drive_.odometry && watch_->scans() == drive_.scans);
    EXPECT_EQ(watch_->clock_set_back(), 0);
  }
  [[nodiscard]] std::string result(const std::string& name, const std::string& file) const {
    return read_file(folder_.path() / name / file);
  }
  /// Kills the component and waits until the launcher has it back.
  void kill(RunningSystem& system, const std::string& component) {
    const pid_t before = system.kill_component(component);
    ASSERT_TRUE(wait([&] {
      const auto row = system.row(component);
      return row && row->pid != 0 && row->pid != before;
    })) << component;
  }

  TemporaryFolder folder_;
  RecordedDrive drive_ = record_drive(folder_.path() / "drive.clf");
  std::optional<LogWatch> watch_;
};

TEST_F(MapLogSystem, PlayersThatAreKilledGoOnAndTheMapIsTheSame) {
  map("undisturbed", 0.0, [](RunningSystem&) {});
  EXPECT_EQ(watch_->repeats(), 0);
  map("disturbed", 4.0, [&](RunningSystem& system) {
    ASSERT_TRUE(wait_for_scans(30));
    kill(system, "lidar_driver");
    ASSERT_TRUE(wait_for_scans(70));
    kill(system, "chassis_driver");
    ASSERT_TRUE(wait_for_scans(110)) << "the playback went on";
  });
  RecordProperty("repeats", watch_->repeats());
  EXPECT_LT(watch_->repeats(), 100) << "of 452 readings and 151 scans";

  const std::string trajectory = result("disturbed", "map_trajectory.txt");
  EXPECT_EQ(trajectory, result("undisturbed", "map_trajectory.txt"));
  EXPECT_EQ(result("disturbed", "map.pgm"), result("undisturbed", "map.pgm"));
  const auto poses = slam::parse_trajectory(trajectory, "trajectory");
  ASSERT_EQ(poses.size(), drive_.odometry.size());
  for (std::size_t i = 1; i < poses.size(); ++i) EXPECT_GT(poses[i].stamp, poses[i - 1].stamp);
}

/// The time that the killed one needs to come back is longer than what is left of the log.
TEST_F(MapLogSystem, ALidarThatComesBackWhenTheLogIsAtItsEndStillTellsItsScans) {
  map("late", 0.0, [&](RunningSystem& system) {
    ASSERT_TRUE(system.wait_for_state("lidar_driver", "ready"));
    ASSERT_TRUE(wait([&] { return system.row("lidar_driver")->pid != 0; }));
    kill(system, "lidar_driver");
  });
}

}  // namespace
}  // namespace coop::test
