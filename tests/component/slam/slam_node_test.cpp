#include <gmock/gmock.h>

#include "component/slam/slam_node_fixture.hpp"
#include "conversions/time.hpp"
#include "core/atomic_file.hpp"
#include "core/map/map_file.hpp"
#include "slam/trajectory_file.hpp"

namespace coop::slam {
namespace {

using testing::HasSubstr;

TEST_F(SlamNodeTest, IsReadyAndSilentBeforeTheFirstScan) {
  start();
  fixture_.advance(5s);
  EXPECT_EQ(health(), Health::kReady);
  EXPECT_TRUE(maps_->empty());
  EXPECT_TRUE(map_transforms().empty());
}

TEST_F(SlamNodeTest, PublishesTheMapAndWhereOdometryLiesInIt) {
  start();
  drive(50);
  ASSERT_FALSE(maps_->empty());
  EXPECT_EQ(maps_->back().header().frame_id(), "map");
  const auto map = conversions::from_msg(maps_->back());
  ASSERT_TRUE(map);
  EXPECT_EQ(map->value.geometry.resolution, 0.05);
  EXPECT_GT(std::ranges::count(map->value.cells, kOccupied), 200);

  const auto transforms = map_transforms();
  EXPECT_GE(transforms.size(), 50U) << "10 Hz over 5 s";
  const auto ahead = *conversions::from_msg(transforms.back().header().stamp()) - fixture_.now();
  EXPECT_GT(ahead, 0ms);
  EXPECT_LE(ahead, 100ms);
  ASSERT_TRUE(error());
  EXPECT_LT(*error(), 0.05);
}

TEST_F(SlamNodeTest, MapIsNotSentAgainWhileNothingChanges) {
  start();
  drive(20);
  fixture_.advance(2s);
  const std::size_t sent = maps_->size();
  fixture_.advance(3s);
  EXPECT_EQ(maps_->size(), sent);
}

TEST_F(SlamNodeTest, ScanWaitsForItsOdometry) {
  start();
  step(false);
  EXPECT_TRUE(map_transforms().empty());
  send_odometry();
  fixture_.advance(100ms);
  EXPECT_FALSE(map_transforms().empty());
}

TEST_F(SlamNodeTest, IsDegradedWhileScansHaveNoOdometryAndRecovers) {
  start();
  for (int i = 0; i < 40; ++i) step(false);
  EXPECT_EQ(health(), Health::kDegraded);
  EXPECT_TRUE(map_transforms().empty());
  drive(40);
  EXPECT_EQ(health(), Health::kReady);
  EXPECT_FALSE(map_transforms().empty());
}

TEST_F(SlamNodeTest, IsDegradedWhenScansStopComing) {
  start();
  drive(5);
  fixture_.advance(4s);
  EXPECT_EQ(health(), Health::kDegraded);
}

TEST_F(SlamNodeTest, WithReliableStreamsScansWaitForEver) {
  start(true);
  for (int i = 0; i < 40; ++i) step(false);  // 4 s, twice the patience
  EXPECT_TRUE(map_transforms().empty());
  // Odometry of the first scan comes at last.
  const Time last = drive_.stamp;
  drive_.stamp = time_from_seconds(1000.1);
  send_odometry();
  drive_.stamp = last;
  send_odometry();
  fixture_.advance(1s);
  fixture_.remove("slam");
  const auto trajectory =
      parse_trajectory(read_file(config_.save_path + "_trajectory.txt"), "trajectory");
  EXPECT_EQ(trajectory.size(), 2U);
}

TEST_F(SlamNodeTest, SavesTheMapOnRequest) {
  start();
  drive(10);
  const auto path = folder_.path() / "on_request";
  request_save("on_request");
  ASSERT_EQ(results_->size(), 1U);
  EXPECT_TRUE(results_->back().success()) << results_->back().detail();
  EXPECT_EQ(results_->back().request_id(), "r1");
  EXPECT_GT(map::load_map(path.string() + ".yaml").geometry.size(), 1000U);
}

TEST_F(SlamNodeTest, RequestWithoutAPathSavesWhereTheMapGoesAtTheEnd) {
  start();
  drive(5);
  request_save("");
  EXPECT_TRUE(results_->back().success());
  EXPECT_TRUE(std::filesystem::exists(config_.save_path + ".yaml"));
}

TEST_F(SlamNodeTest, RequestThatCannotBeMetIsAnsweredWithTheReason) {
  start();
  request_save("x");
  ASSERT_EQ(results_->size(), 1U);
  EXPECT_FALSE(results_->back().success());
  EXPECT_THAT(results_->back().detail(), HasSubstr("no map"));
  drive(3);
  std::filesystem::create_directory(folder_.path() / "taken.pgm");
  request_save("taken");
  EXPECT_FALSE(results_->back().success());
  EXPECT_THAT(results_->back().detail(), HasSubstr("taken"));
}

TEST_F(SlamNodeTest, ARequestNamesAMapAndNeverAPath) {
  start();
  drive(3);
  const std::string elsewhere = (folder_.path() / "elsewhere").string();
  for (const std::string& path : {elsewhere, std::string("../x"), std::string("a/b")}) {
    request_save(path);
    EXPECT_FALSE(results_->back().success()) << path;
    EXPECT_THAT(results_->back().detail(), HasSubstr("is no name")) << path;
  }
  EXPECT_FALSE(std::filesystem::exists(elsewhere + ".yaml"));
}

TEST_F(SlamNodeTest, SavesMapAndTrajectoryAtTheEndWithAllThatHadArrived) {
  start();
  drive(30);
  // Arrived, but the timer that maps them does not run any more. A live stream keeps five.
  for (int i = 0; i < 5; ++i) {
    drive_.follow_tour();
    send_odometry();
    send_scan();
  }
  fixture_.remove("slam");
  const auto grid = map::load_map(config_.save_path + ".yaml");
  EXPECT_GT(std::ranges::count(grid.cells, kOccupied), 200);
  const auto trajectory =
      parse_trajectory(read_file(config_.save_path + "_trajectory.txt"), "trajectory");
  ASSERT_EQ(trajectory.size(), readings_);
  EXPECT_EQ(trajectory.back().stamp, drive_.stamp);
  const Pose2 truth = start_.inverse() * drive_.base_in_map;
  EXPECT_LT(distance(trajectory.back().pose, truth), 0.05);
}

TEST_F(SlamNodeTest, ClockSetBackStartsAMapAnew) {
  start();
  drive(20);
  const std::size_t before = maps_->size();
  ASSERT_GT(before, 0U);
  fixture_.set_time(time_from_seconds(500.0));
  fixture_.node_of("slam").handle_clock_jump();
  drive_.stamp = time_from_seconds(500.0);
  transforms_->clear();
  fixture_.advance(1s);
  EXPECT_TRUE(map_transforms().empty()) << "the old map is gone and a new one not begun";
  mount_laser();
  step();
  const auto transforms = map_transforms();
  ASSERT_FALSE(transforms.empty());
  const auto& t = transforms.back().transform().translation();
  const Pose2 odom_in_map = drive_.base_in_odom.inverse();  // the robot is at the new map's origin
  EXPECT_NEAR(t.x(), odom_in_map.x, 1e-6);
  EXPECT_NEAR(t.y(), odom_in_map.y, 1e-6);
}

TEST_F(SlamNodeTest, MalformedScansAreRefusedWithoutHarm) {
  start();
  auto message = conversions::to_msg(drive_.scan());
  message.angle_increment(std::numeric_limits<float>::quiet_NaN());
  scan_.publish(message);
  drive(5);
  EXPECT_EQ(health(), Health::kReady);
  EXPECT_FALSE(map_transforms().empty());
}

TEST_F(SlamNodeTest, OdometryThatStartsAgainAtZeroDoesNotMoveTheRobotInTheMap) {
  start();
  drive(80);
  restart_odometry();
  drive(80);
  EXPECT_EQ(health(), Health::kReady);
  ASSERT_TRUE(error());
  EXPECT_LT(*error(), 0.06);
}

}  // namespace
}  // namespace coop::slam
