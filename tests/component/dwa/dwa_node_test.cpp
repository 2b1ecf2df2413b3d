#include "dwa/node/dwa_node.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "conversions/detections.hpp"
#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "coop_msgs/msg/EmergencyStop.h"
#include "support/component_fixture.hpp"

namespace coop::dwa {
namespace {

using namespace std::chrono_literals;
using coop_msgs::msg::EmergencyStop;
using coop_msgs::msg::NavigationStatus;
using geometry_msgs::msg::TwistStamped;
using nav_msgs::msg::Path;
using runtime::Health;
using runtime::Qos;
namespace Constants = coop_msgs::msg::NavigationStatus_Constants;

/// The shell with a base that does what cmd_vel says; odometry at 50 Hz, scans at 10 Hz.
class DwaNodeTest : public testing::Test {
 protected:
  explicit DwaNodeTest(const DwaNodeConfig& config = {}) {
    runtime::Node& tester = fixture_.tester();
    odometry_ = tester.advertise<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
    scans_ = tester.advertise<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream);
    plans_ = tester.advertise<Path>("plan", Qos::kStateLatched);
    stops_ = tester.advertise<EmergencyStop>("emergency_stop", Qos::kStateLatched);
    commands_ = fixture_.collect<TwistStamped>("cmd_vel", Qos::kCommand);
    statuses_ = fixture_.collect<NavigationStatus>("navigation_status", Qos::kStateLatched);
    tester.publish_static_transform("base_link", "laser_link", to_pose3(Pose2{0.62, 0.0, 0.0}));
    fixture_.add<DwaNode>("dwa", config);
  }

  void run(double duration, bool with_scans = true) {
    for (int i = 0; i < static_cast<int>(std::lround(duration / 0.02)); ++i) {
      Twist2 twist;
      if (!commands_->empty()) {
        const auto command = conversions::from_msg(commands_->back());
        if (command) twist = command->value;
      }
      robot_ = vehicle::advance_along_arc(robot_, twist.v * 0.02, twist.omega * 0.02);
      fixture_.advance(20ms);
      const Time now = fixture_.now();
      fixture_.tester().publish_transform("map", "odom", now, Pose2{});
      fixture_.tester().publish_transform("odom", "base_link", now, robot_);
      conversions::FramedOdometry odometry;
      odometry.odometry = {now, robot_, twist};
      odometry_.publish(conversions::to_msg(odometry));
      if (with_scans && ticks_++ % 5 == 0) scans_.publish(conversions::to_msg(scan(now)));
      fixture_.settle();
    }
  }

  static LaserScan scan(Time now) {
    LaserScan scan;
    scan.stamp = now;
    scan.frame_id = "laser_link";
    scan.angle_min = -3.0F;
    scan.angle_increment = 0.1F;
    scan.range_min = 0.1F;
    scan.range_max = 8.0F;
    scan.ranges.assign(61, 7.0F);
    return scan;
  }

  std::string send_plan(double length) {
    std::vector<Pose2> poses;
    for (int i = 0; i * 0.05 <= length + 1e-9; ++i) {
      poses.push_back({robot_.x + 0.05 * i, robot_.y, 0.0});
    }
    plans_.publish(conversions::to_path_msg({fixture_.now(), "map", poses}));
    return std::to_string(to_nanoseconds(fixture_.now()));
  }
  void send_stop(bool engaged) {
    EmergencyStop stop;
    stop.source("test");
    stop.engaged(engaged);
    stops_.publish(stop);
  }
  [[nodiscard]] double speed() const { return commands_->back().twist().linear().x(); }

  test::ComponentFixture fixture_;
  runtime::Publisher<nav_msgs::msg::Odometry> odometry_;
  runtime::Publisher<sensor_msgs::msg::LaserScan> scans_;
  runtime::Publisher<Path> plans_;
  runtime::Publisher<EmergencyStop> stops_;
  std::shared_ptr<std::vector<TwistStamped>> commands_;
  std::shared_ptr<std::vector<NavigationStatus>> statuses_;
  Pose2 robot_;
  int ticks_ = 0;
};

TEST_F(DwaNodeTest, SendsZeroTwentyTimesASecondBeforeAnyInput) {
  fixture_.advance(1s);
  EXPECT_NEAR(static_cast<double>(commands_->size()), 20.0, 1.0);
  for (const TwistStamped& command : *commands_) {
    EXPECT_EQ(command.twist().linear().x(), 0.0);
    EXPECT_EQ(command.header().frame_id(), "base_link");
  }
  EXPECT_EQ(statuses_->back().reason(), Constants::NO_POSE);
  EXPECT_EQ(fixture_.node_of("dwa").health(), Health::kDegraded);
}

TEST_F(DwaNodeTest, DrivesAPlanToItsEndAndReportsTheGoalsName) {
  run(0.5);
  const std::string id = send_plan(2.0);
  run(1.0);
  EXPECT_GT(speed(), 0.0);
  EXPECT_EQ(statuses_->back().state(), Constants::DRIVING);
  run(12.0);
  EXPECT_EQ(statuses_->back().state(), Constants::ARRIVED);
  EXPECT_EQ(statuses_->back().goal_id(), id);
  EXPECT_EQ(speed(), 0.0);
  EXPECT_NEAR(robot_.x, 2.0, 0.05);
}

TEST_F(DwaNodeTest, StopsWithoutScansAndSaysWhy) {
  run(0.5);
  send_plan(4.0);
  run(1.5);
  EXPECT_GT(speed(), 0.0);
  run(1.0, false);
  EXPECT_EQ(speed(), 0.0);
  EXPECT_EQ(statuses_->back().reason(), Constants::SENSOR_STALE);
  EXPECT_EQ(fixture_.node_of("dwa").health(), Health::kDegraded);
  run(1.0);
  EXPECT_GT(speed(), 0.0);
}

TEST_F(DwaNodeTest, StopsWhenTransformsAndOdometryStop) {
  run(0.5);
  send_plan(4.0);
  run(1.5);
  fixture_.advance(1s);
  EXPECT_EQ(speed(), 0.0);
  EXPECT_EQ(statuses_->back().reason(), Constants::NO_POSE);
}

TEST_F(DwaNodeTest, ObeysTheEmergencyStop) {
  run(0.5);
  send_plan(4.0);
  run(1.5);
  send_stop(true);
  run(0.2);
  EXPECT_EQ(speed(), 0.0);
  EXPECT_EQ(statuses_->back().reason(), Constants::EMERGENCY_STOP);
  send_stop(false);
  run(1.0);
  EXPECT_GT(speed(), 0.0);
}

TEST_F(DwaNodeTest, AnEmptyPlanStopsTheRobot) {
  run(0.5);
  send_plan(4.0);
  run(1.5);
  plans_.publish(conversions::to_path_msg({fixture_.now(), "map", {}}));
  run(0.2);
  EXPECT_EQ(speed(), 0.0);
  EXPECT_EQ(statuses_->back().state(), Constants::IDLE);
}

TEST_F(DwaNodeTest, ShowsWhatItWeighsToThoseWhoListen) {
  const auto candidates =
      fixture_.collect<coop_msgs::msg::DwaCandidates>("dwa_candidates", Qos::kSensorStream);
  const auto costmaps =
      fixture_.collect<nav_msgs::msg::OccupancyGrid>("local_costmap", Qos::kSensorStream);
  run(0.5);
  send_plan(4.0);
  run(2.0);
  EXPECT_GE(candidates->size(), 5U);
  EXPECT_LE(candidates->size(), 15U);  // 5 Hz at most
  EXPECT_GE(costmaps->size(), 5U);
  const auto& last = candidates->back();
  ASSERT_GE(last.chosen(), 0);
  EXPECT_TRUE(last.candidates()[static_cast<std::size_t>(last.chosen())].admissible());
}

TEST(DwaNodeCheck, RefusesARobotThatIsNotThere) {
  DwaNodeConfig config;
  config.robot = "no/such.urdf";
  EXPECT_ANY_THROW(DwaNode::check(config));
}

DwaNodeConfig with_animals() {
  DwaNodeConfig config;
  config.dwa.animals.use = true;
  return config;
}

class DwaNodeInAPenTest : public DwaNodeTest {
 protected:
  DwaNodeInAPenTest() : DwaNodeTest(with_animals()) {
    animals_ =
        fixture_.tester().advertise<vision_msgs::msg::Detection3DArray>("animals", Qos::kEvent);
  }
  void see_pig(const std::string& frame, const Eigen::Vector2d& at) {
    Detection pig;
    pig.class_id = "pig";
    pig.position = {at.x(), at.y(), 0.2};
    pig.size = {0.4, 0.4, 0.4};
    animals_.publish(
        conversions::to_msg(Stamped<std::vector<Detection>>{fixture_.now(), frame, {pig}}));
  }
  void run_with_pig(double duration, const std::string& frame) {
    for (int i = 0; i < static_cast<int>(std::lround(duration / 0.1)); ++i) {
      see_pig(frame, {2.0, 0.0});
      run(0.1);
    }
  }
  runtime::Publisher<vision_msgs::msg::Detection3DArray> animals_;
};

TEST_F(DwaNodeInAPenTest, WaitsForAnAnimalThatTheLaserDoesNotSee) {
  run(0.5);
  send_plan(3.0);
  run_with_pig(8.0, "map");
  EXPECT_EQ(speed(), 0.0);
  EXPECT_GT(robot_.x, 0.2);
  EXPECT_LT(robot_.x + 0.77, 1.8);  // its nose before the pig's edge
  EXPECT_EQ(statuses_->back().state(), Constants::DRIVING);
  const double stood_at = robot_.x;
  run(3.0);  // it is gone
  EXPECT_NE(robot_.x, stood_at);
}

TEST_F(DwaNodeInAPenTest, AnimalsInAnotherFrameAreRefused) {
  run(0.5);
  send_plan(3.0);
  run_with_pig(8.0, "odom");
  EXPECT_GT(robot_.x, 1.5);
}

}  // namespace
}  // namespace coop::dwa
