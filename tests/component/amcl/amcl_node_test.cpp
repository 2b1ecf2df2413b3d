#include "amcl/node/amcl_node.hpp"

#include <coop_msgs/msg/GlobalLocalization.h>
#include <gtest/gtest.h>
#include <nav_msgs/msg/Odometry.h>
#include <sensor_msgs/msg/LaserScan.h>

#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "core/atomic_file.hpp"
#include "core/config/error.hpp"
#include "core/map/map_file.hpp"
#include "support/component_fixture.hpp"
#include "support/simulated_room.hpp"
#include "support/temporary_folder.hpp"

namespace coop::amcl {
namespace {

using namespace std::chrono_literals;
using geometry_msgs::msg::PoseWithCovarianceStamped;
using runtime::Health;
using runtime::Qos;

class AmclNodeTest : public testing::Test {
 protected:
  AmclNodeTest() {
    map::save_map(coop::test::mapped(coop::test::barn()), folder_.path() / "barn");
    config_.map_file = (folder_.path() / "barn.yaml").string();
    config_.initial_pose = {.known = true, .x = 2.0, .y = 1.5, .yaw = 0.0};
    options_.run_dir = folder_.path();
    runtime::Node& tester = fixture_.tester();
    odometry_ = tester.advertise<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
    scans_ = tester.advertise<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream);
    tester.publish_static_transform("base_link", "laser_link", to_pose3(drive_.laser_in_base));
  }

  void start() { fixture_.add<AmclNode>("amcl", config_, options_); }

  void send_odometry() {
    fixture_.tester().publish_transform("odom", "base_link", drive_.stamp, drive_.base_in_odom);
    conversions::FramedOdometry odometry;
    odometry.odometry.stamp = drive_.stamp;
    odometry.odometry.base_in_odom = drive_.base_in_odom;
    odometry_.publish(conversions::to_msg(odometry));
  }

  /// The robot drives its tour: odometry and a scan every 100 ms.
  void drive(int steps, bool with_scans = true) {
    for (int i = 0; i < steps; ++i) {
      drive_.follow_tour();
      fixture_.advance(100ms);
      send_odometry();
      if (with_scans) scans_.publish(conversions::to_msg(drive_.scan()));
      fixture_.settle();
    }
  }

  /// Distance of the pose that transforms tell from the true one; nothing where they tell none.
  [[nodiscard]] std::optional<double> error_at(Time stamp) {
    const auto pose = fixture_.tester().transforms().lookup("map", "base_link", stamp);
    if (!pose) return std::nullopt;
    return distance(to_pose2(*pose), drive_.base_in_map);
  }
  [[nodiscard]] Health health() { return fixture_.node_of("amcl").health(); }

  coop::test::TemporaryFolder folder_;
  coop::test::ComponentFixture fixture_;
  coop::test::SimulatedDrive drive_{coop::test::barn(), {2, 1.5, 0}, 1};
  AmclNodeConfig config_;
  runtime::Options options_;
  runtime::Publisher<sensor_msgs::msg::LaserScan> scans_;
  runtime::Publisher<nav_msgs::msg::Odometry> odometry_;
};

TEST_F(AmclNodeTest, ServesTheMapToWhoeverComesLater) {
  start();
  const auto maps = fixture_.collect<nav_msgs::msg::OccupancyGrid>("map", Qos::kStateLatched);
  ASSERT_EQ(maps->size(), 1U);
  EXPECT_EQ(maps->front().header().frame_id(), "map");
  EXPECT_EQ(maps->front().info().width(), 299U);
}

TEST_F(AmclNodeTest, WithoutScansItTellsNoPoseAndIsDegraded) {
  (void)fixture_.tester().transforms();
  start();
  drive(20, false);
  EXPECT_EQ(health(), Health::kDegraded);
  EXPECT_FALSE(error_at(drive_.stamp).has_value());
}

TEST_F(AmclNodeTest, TracksTheRobotAndStampsItsTransformAhead) {
  (void)fixture_.tester().transforms();
  const auto poses = fixture_.collect<PoseWithCovarianceStamped>("amcl_pose", Qos::kStateLatched);
  start();
  drive(100);
  EXPECT_EQ(health(), Health::kReady);
  const auto error = error_at(drive_.stamp);
  ASSERT_TRUE(error.has_value());
  EXPECT_LT(*error, 0.08);
  EXPECT_GT(poses->size(), 20U);
  const auto newest = fixture_.tester().transforms().newest_stamp("map", "odom");
  ASSERT_TRUE(newest.has_value());
  EXPECT_GT(*newest, fixture_.now());
}

TEST_F(AmclNodeTest, GoesOnTellingTheTransformWhileScansStopAndSaysSo) {
  (void)fixture_.tester().transforms();
  start();
  drive(50);
  ASSERT_EQ(health(), Health::kReady);
  fixture_.advance(2s);
  EXPECT_EQ(health(), Health::kDegraded);
  EXPECT_GT(fixture_.tester().transforms().newest_stamp("map", "odom").value_or(Time{}),
            fixture_.now());
}

TEST_F(AmclNodeTest, AfterACrashItGoesOnFromThePoseOnDisk) {
  (void)fixture_.tester().transforms();
  start();
  drive(100);
  fixture_.remove("amcl", true);
  drive(10);  // the robot drives on unobserved
  start();
  drive(3);
  const auto error = error_at(drive_.stamp);
  ASSERT_TRUE(error.has_value()) << "the pose of the configuration is metres away";
  EXPECT_LT(*error, 0.15);
}

TEST_F(AmclNodeTest, APoseOnDiskOfAnotherMapIsNotUsed) {
  (void)fixture_.tester().transforms();
  SavedPose saved;
  saved.map_hash = 1;
  saved.stamp = fixture_.now();
  saved.robot_in_map.pose = {11, 7, 2};
  write_file_atomically(folder_.path() / "amcl.pose", to_text(saved));
  start();
  drive(30);
  const auto error = error_at(drive_.stamp);
  ASSERT_TRUE(error.has_value());
  EXPECT_LT(*error, 0.15);
}

TEST_F(AmclNodeTest, AnInitialPoseFromAPersonReplacesAWrongOne) {
  (void)fixture_.tester().transforms();
  config_.initial_pose = {.known = true, .x = 12.5, .y = 7.5, .yaw = 2.0};
  start();
  drive(2);
  auto initial = fixture_.tester().advertise<PoseWithCovarianceStamped>("initialpose", Qos::kEvent);
  PoseEstimate estimate{drive_.base_in_map, Eigen::Matrix3d::Identity() * 0.02};
  initial.publish(conversions::to_msg(Stamped<PoseEstimate>{fixture_.now(), "map", estimate}));
  drive(30);
  const auto error = error_at(drive_.stamp);
  ASSERT_TRUE(error.has_value());
  EXPECT_LT(*error, 0.1);
}

TEST_F(AmclNodeTest, AnInitialPoseInAnotherFrameIsRefused) {
  (void)fixture_.tester().transforms();
  start();
  drive(50);
  auto initial = fixture_.tester().advertise<PoseWithCovarianceStamped>("initialpose", Qos::kEvent);
  PoseEstimate estimate{{12, 7, 1}, Eigen::Matrix3d::Identity() * 0.01};
  initial.publish(conversions::to_msg(Stamped<PoseEstimate>{fixture_.now(), "odom", estimate}));
  drive(5);
  EXPECT_LT(error_at(drive_.stamp).value_or(99.0), 0.1);
}

TEST_F(AmclNodeTest, GlobalLocalisationOnRequestFindsTheRobotAgain) {
  (void)fixture_.tester().transforms();
  config_.initial_pose = {.known = true, .x = 12.5, .y = 7.5, .yaw = 2.0};
  start();
  drive(2);
  auto request = fixture_.tester().advertise<coop_msgs::msg::GlobalLocalization>(
      "global_localization", Qos::kEvent);
  request.publish(coop_msgs::msg::GlobalLocalization());
  drive(150);
  EXPECT_EQ(health(), Health::kReady);
  EXPECT_LT(error_at(drive_.stamp).value_or(99.0), 0.1);
}

TEST_F(AmclNodeTest, OdometryThatStartsAgainAtZeroDoesNotMoveTheRobot) {
  start();
  drive(50);
  drive_.base_in_odom = {};
  odometry_ = fixture_.tester().advertise<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
  (void)fixture_.tester().transforms();  // from here on: it knows nothing of the odometry before
  drive(20);
  EXPECT_EQ(health(), Health::kReady);
  EXPECT_LT(error_at(drive_.stamp).value_or(99.0), 0.1);
}

TEST_F(AmclNodeTest, SaysThatTheScansDoNotFitAndFindsTheRobotThoughItStands) {
  (void)fixture_.tester().transforms();
  config_.initial_pose = {.known = true, .x = 12.5, .y = 7.5, .yaw = 2.0};
  start();
  int told = 0;
  for (int i = 0; i < 100; ++i) {
    drive_.wait();
    fixture_.advance(100ms);
    send_odometry();
    scans_.publish(conversions::to_msg(drive_.scan()));
    fixture_.settle();
    const auto error = error_at(drive_.stamp);
    told += error && *error > 0.3 ? 1 : 0;
  }
  EXPECT_LT(told, 5) << "a wrong pose is not told for long";
  EXPECT_EQ(health(), Health::kReady);
  EXPECT_LT(error_at(drive_.stamp).value_or(99.0), 0.1);
}

TEST(AmclNodeConfigTest, AMapIsRequired) {
  EXPECT_THROW(AmclNode::check({}), config::Error);
  AmclNodeConfig config;
  config.map_file = "no/such/map.yaml";
  EXPECT_ANY_THROW(AmclNode::check(config));
}

}  // namespace
}  // namespace coop::amcl
