#include "slam/node/slam_node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/msg/Odometry.h>
#include <sensor_msgs/msg/LaserScan.h>
#include <tf2_msgs/msg/TFMessage.h>

#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "conversions/time.hpp"
#include "core/atomic_file.hpp"
#include "core/map/map_file.hpp"
#include "slam/trajectory_file.hpp"
#include "support/component_fixture.hpp"
#include "support/simulated_room.hpp"
#include "support/temporary_folder.hpp"

namespace coop::slam {
namespace {

using namespace std::chrono_literals;
using runtime::Health;
using runtime::Qos;
using testing::HasSubstr;

class SlamNodeTest : public testing::Test {
 protected:
  SlamNodeTest() : drive_(test::barn(), {2.0, 1.5, 0.0}, 5), start_(drive_.base_in_map) {
    config_.slam.particles = 3;
    config_.save_path = (folder_.path() / "barn").string();
    maps_ = fixture_.collect<nav_msgs::msg::OccupancyGrid>("map", Qos::kStateLatched);
    transforms_ = fixture_.collect<tf2_msgs::msg::TFMessage>("tf", Qos::kEvent);
    results_ = fixture_.collect<coop_msgs::msg::SaveMapResult>("save_map_result", Qos::kEvent);
    odometry_ = fixture_.tester().advertise<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
    scan_ = fixture_.tester().advertise<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream);
    save_ = fixture_.tester().advertise<coop_msgs::msg::SaveMap>("save_map", Qos::kEvent);
  }

  void start(bool reliable = false) {
    runtime::Options options;
    options.reliable_streams = reliable;
    options.run_dir = folder_.path();
    fixture_.add<SlamNode>("slam", config_, options);
    mount_laser();
  }
  void mount_laser() {
    fixture_.tester().publish_static_transform("base_link", "laser_link",
                                               to_pose3(drive_.laser_in_base));
    fixture_.settle();
  }
  void send_odometry() {
    conversions::FramedOdometry odometry;
    odometry.odometry.stamp = drive_.stamp;
    odometry.odometry.base_in_odom = drive_.base_in_odom;
    odometry_.publish(conversions::to_msg(odometry));
    ++readings_;
  }
  void send_scan() { scan_.publish(conversions::to_msg(drive_.scan())); }
  /// A tenth of a second of the tour.
  void step(bool with_odometry = true) {
    drive_.follow_tour();
    if (!moved_) start_ = drive_.base_in_map;
    moved_ = true;
    if (with_odometry) send_odometry();
    send_scan();
    fixture_.advance(100ms);
  }
  void drive(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }
  void request_save(const std::string& path) {
    coop_msgs::msg::SaveMap request;
    request.request_id("r1");
    request.path(path);
    save_.publish(request);
    fixture_.settle();
  }
  [[nodiscard]] std::vector<geometry_msgs::msg::TransformStamped> map_transforms() const {
    std::vector<geometry_msgs::msg::TransformStamped> found;
    for (const auto& message : *transforms_) {
      for (const auto& transform : message.transforms()) {
        if (transform.header().frame_id() == "map" && transform.child_frame_id() == "odom")
          found.push_back(transform);
      }
    }
    return found;
  }
  [[nodiscard]] Health health() { return fixture_.node_of("slam").health(); }

  test::TemporaryFolder folder_;
  test::ComponentFixture fixture_;
  test::SimulatedDrive drive_;
  Pose2 start_;
  bool moved_ = false;
  std::size_t readings_ = 0;
  SlamNodeConfig config_;
  std::shared_ptr<std::vector<nav_msgs::msg::OccupancyGrid>> maps_;
  std::shared_ptr<std::vector<tf2_msgs::msg::TFMessage>> transforms_;
  std::shared_ptr<std::vector<coop_msgs::msg::SaveMapResult>> results_;
  runtime::Publisher<nav_msgs::msg::Odometry> odometry_;
  runtime::Publisher<sensor_msgs::msg::LaserScan> scan_;
  runtime::Publisher<coop_msgs::msg::SaveMap> save_;
};

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
  const auto& t = transforms.back().transform();
  const Pose2 odom_in_map{t.translation().x(), t.translation().y(),
                          2.0 * std::atan2(t.rotation().z(), t.rotation().w())};
  const Pose2 truth = start_.inverse() * drive_.base_in_map;
  EXPECT_LT(distance(odom_in_map * drive_.base_in_odom, truth), 0.05);
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
  request_save(path.string());
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
  request_save((folder_.path() / "x").string());
  ASSERT_EQ(results_->size(), 1U);
  EXPECT_FALSE(results_->back().success());
  EXPECT_THAT(results_->back().detail(), HasSubstr("no map"));
  drive(3);
  write_file_atomically(folder_.path() / "file", "");
  request_save((folder_.path() / "file" / "x").string());
  EXPECT_FALSE(results_->back().success());
  EXPECT_THAT(results_->back().detail(), HasSubstr("file"));
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

/// The best map so far, cells that are occupied.
std::ptrdiff_t walls_of(const nav_msgs::msg::OccupancyGrid& message) {
  const auto map = conversions::from_msg(message);
  return map ? std::ranges::count(map->value.cells, kOccupied) : -1;
}

class SlamNodeAfterADeath : public SlamNodeTest {
 protected:
  SlamNodeAfterADeath() { config_.session_period = 5.0; }

  void map_and_die() {
    start();
    drive(120);
    walls_ = walls_of(maps_->back());
    fixture_.remove("slam", true);  // ends only when the session being written is on disk
    ASSERT_TRUE(std::filesystem::exists(session()));
    maps_->clear();
    transforms_->clear();
  }
  [[nodiscard]] std::filesystem::path session() const { return folder_.path() / "slam.session"; }
  /// Of the pose that is told, seen from the first map's origin; nothing where none is told.
  [[nodiscard]] std::optional<double> error() const {
    const auto transforms = map_transforms();
    if (transforms.empty()) return std::nullopt;
    const auto& t = transforms.back().transform();
    const Pose2 odom_in_map{t.translation().x(), t.translation().y(),
                            2.0 * std::atan2(t.rotation().z(), t.rotation().w())};
    return distance(odom_in_map * drive_.base_in_odom, start_.inverse() * drive_.base_in_map);
  }

  std::ptrdiff_t walls_ = 0;
};

TEST_F(SlamNodeAfterADeath, GoesOnWithTheMapOfTheSession) {
  map_and_die();
  for (int i = 0; i < 10; ++i) drive_.follow_tour();  // half a metre, unobserved
  fixture_.set_time(drive_.stamp);
  start();
  fixture_.advance(1s);
  ASSERT_FALSE(maps_->empty()) << "the map is told at once";
  EXPECT_GT(walls_of(maps_->back()), 0.7 * static_cast<double>(walls_));
  EXPECT_TRUE(map_transforms().empty()) << "where the robot is in it is not known yet";
  drive_.stamp = fixture_.now();
  drive(20);
  EXPECT_EQ(health(), Health::kReady);
  ASSERT_TRUE(error());
  EXPECT_LT(*error(), 0.08);
  fixture_.remove("slam");
  const auto trajectory =
      parse_trajectory(read_file(config_.save_path + "_trajectory.txt"), "trajectory");
  EXPECT_LT(trajectory.front().stamp, time_from_seconds(1001.0)) << "the way before is kept";
}

TEST_F(SlamNodeAfterADeath, GoesOnThoughOdometryWasRestartedAsWell) {
  map_and_die();
  drive_.base_in_odom = {};
  odometry_ = fixture_.tester().advertise<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
  start();
  drive(20);
  ASSERT_TRUE(error());
  EXPECT_LT(*error(), 0.08);
}

TEST_F(SlamNodeAfterADeath, BeginsAnewWhereToldTo) {
  map_and_die();
  config_.resume = false;
  start();
  fixture_.advance(2s);
  EXPECT_TRUE(maps_->empty());
}

TEST_F(SlamNodeAfterADeath, BeginsAnewWhereTheSessionIsCutOrOfAnotherResolution) {
  map_and_die();
  const std::string whole = read_file(session());
  write_file_atomically(session(), std::string_view(whole).substr(0, whole.size() / 2));
  start();
  fixture_.advance(2s);
  EXPECT_TRUE(maps_->empty());
  drive_.stamp = fixture_.now();
  drive(15);
  EXPECT_FALSE(maps_->empty());
  fixture_.remove("slam", true);
  maps_->clear();
  write_file_atomically(session(), whole);
  config_.slam.resolution = 0.1;
  start();
  fixture_.advance(2s);
  EXPECT_TRUE(maps_->empty());
}

TEST_F(SlamNodeAfterADeath, BeginsAnewWhereTheSessionIsOfAnotherTime) {
  map_and_die();
  fixture_.set_time(time_from_seconds(10.0));
  drive_.stamp = fixture_.now();
  start();
  step();
  moved_ = false;
  drive(10);
  ASSERT_FALSE(map_transforms().empty());
  EXPECT_LT(walls_of(maps_->back()), walls_) << "a few scans only";
}

TEST_F(SlamNodeAfterADeath, ARobotThatIsElsewhereBeginsAnewAfterAWhile) {
  map_and_die();
  drive_.base_in_map = {10.5, 7.2, 2.5};
  drive_.base_in_odom = {};
  odometry_ = fixture_.tester().advertise<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
  start();
  const auto stand = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      drive_.wait();
      send_odometry();
      send_scan();
      fixture_.advance(100ms);
    }
  };
  stand(30);
  EXPECT_EQ(health(), Health::kDegraded);
  EXPECT_TRUE(map_transforms().empty());
  stand(90);
  EXPECT_EQ(health(), Health::kReady);
  EXPECT_FALSE(map_transforms().empty());
}

TEST_F(SlamNodeTest, OdometryThatStartsAgainAtZeroDoesNotMoveTheRobotInTheMap) {
  start();
  drive(80);
  drive_.base_in_odom = {};
  odometry_ = fixture_.tester().advertise<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
  drive(80);
  EXPECT_EQ(health(), Health::kReady);
  const auto& t = map_transforms().back().transform();
  const Pose2 odom_in_map{t.translation().x(), t.translation().y(),
                          2.0 * std::atan2(t.rotation().z(), t.rotation().w())};
  EXPECT_LT(distance(odom_in_map * drive_.base_in_odom, start_.inverse() * drive_.base_in_map),
            0.06);
}

}  // namespace
}  // namespace coop::slam
