#include "simulator/node/simulator_node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tf2_msgs/msg/TFMessage.h>

#include <fstream>

#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "conversions/time.hpp"
#include "conversions/world.hpp"
#include "core/config/error.hpp"
#include "core/world/shapes.hpp"
#include "support/component_fixture.hpp"
#include "support/temporary_folder.hpp"

namespace coop::simulator {
namespace {

using namespace std::chrono_literals;
using runtime::Qos;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kSource = COOP_SOURCE_DIR;

class SimulatorNodeTest : public testing::Test {
 protected:
  SimulatorNodeTest() {
    config_.robot = kSource + "/config/robot/egg_collector.urdf";
    config_.world = (folder_.path() / "test.world.yaml").string();
    std::ofstream(config_.world) << "map: " << kSource << "/maps/duck_house.yaml\n"
                                 << "robot_start: {x: 2.0, y: 3.0, yaw: 0.0}\n"
                                 << "eggs: [{id: egg, x: 2.92, y: 3.0}]\n";
    options_.run_dir = folder_.path();
    options_.seed = 5;
  }

  void start() { fixture_.add<SimulatorNode>("simulator", config_, options_); }

  /// Commands at 20 Hz, as a driver would send them.
  void drive(const Twist2& command, Duration duration) {
    if (!cmd_vel_) {
      cmd_vel_.emplace(
          fixture_.tester().advertise<geometry_msgs::msg::TwistStamped>("cmd_vel", Qos::kCommand));
    }
    for (Duration done{0}; done < duration; done += 50ms) {
      cmd_vel_->publish(conversions::to_msg(Stamped<Twist2>{fixture_.now(), "base_link", command}));
      fixture_.advance(50ms);
    }
  }

  static world::GroundTruth last(const std::vector<coop_msgs::msg::GroundTruth>& messages) {
    return conversions::from_msg(messages.at(messages.size() - 1)).value();
  }

  coop::test::TemporaryFolder folder_;
  coop::test::ComponentFixture fixture_;
  SimulatorConfig config_;
  runtime::Options options_;
  std::optional<runtime::Publisher<geometry_msgs::msg::TwistStamped>> cmd_vel_;
};

TEST_F(SimulatorNodeTest, PublishesEachTopicAtItsRateInSimulatedTime) {
  start();
  const auto clocks = fixture_.collect<rosgraph_msgs::msg::Clock>("clock", Qos::kEvent);
  const auto odoms = fixture_.collect<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
  const auto imus = fixture_.collect<sensor_msgs::msg::Imu>("imu", Qos::kSensorStream);
  const auto truths =
      fixture_.collect<coop_msgs::msg::GroundTruth>("ground_truth", Qos::kSensorStream);
  fixture_.advance(1010ms);  // the first call of the timer starts the count
  ASSERT_EQ(clocks->size(), 100U);
  EXPECT_EQ(imus->size(), 100U);
  EXPECT_EQ(odoms->size(), 50U);
  EXPECT_EQ(truths->size(), 50U);
  EXPECT_EQ(*conversions::from_msg(clocks->front()), Simulation::kStart + 10ms);
  EXPECT_EQ(*conversions::from_msg(clocks->back()), Simulation::kStart + 1s);
  EXPECT_EQ(*conversions::from_msg(odoms->back().header().stamp()), Simulation::kStart + 1s);
  EXPECT_EQ(odoms->back().header().frame_id(), "odom");
  EXPECT_EQ(odoms->back().child_frame_id(), "base_link");
  EXPECT_EQ(imus->back().header().frame_id(), "imu_link");
}

TEST_F(SimulatorNodeTest, RunsFasterThanTheWallWhenAskedTo) {
  config_.rate = 8.0;
  start();
  const auto clocks = fixture_.collect<rosgraph_msgs::msg::Clock>("clock", Qos::kEvent);
  fixture_.advance(10ms);
  fixture_.advance(1s);
  EXPECT_EQ(clocks->size(), 800U);
}

TEST_F(SimulatorNodeTest, TellsItsWorldToWhoComesLate) {
  start();
  fixture_.advance(1s);
  const auto worlds = fixture_.collect<coop_msgs::msg::World>("world", Qos::kStateLatched);
  ASSERT_EQ(worlds->size(), 1U);
  const world::World world = conversions::from_msg(worlds->front()).value();
  EXPECT_EQ(world.seed, 5U);
  EXPECT_EQ(world.robot_start, (Pose2{2.0, 3.0, 0.0}));
  ASSERT_EQ(world.eggs.size(), 1U);
  EXPECT_EQ(world.eggs[0].id, "egg");
  EXPECT_THAT(world.map_path, HasSubstr("duck_house.yaml"));
  EXPECT_EQ(world.grid.geometry.resolution, 0.05);
}

TEST_F(SimulatorNodeTest, DrivesByCommandsAndStopsWhenTheyCease) {
  start();
  const auto truths =
      fixture_.collect<coop_msgs::msg::GroundTruth>("ground_truth", Qos::kSensorStream);
  (void)fixture_.tester().transforms();
  drive({0.4, 0.0}, 4s);
  EXPECT_NEAR(last(*truths).velocity.v, 0.4, 0.02);
  EXPECT_GT(last(*truths).robot_in_world.x, 3.0);
  const auto odom_to_base =
      fixture_.tester().transforms().lookup("odom", "base_link", last(*truths).stamp);
  ASSERT_TRUE(odom_to_base.has_value());
  EXPECT_NEAR(odom_to_base->translation().x(), last(*truths).robot_in_world.x - 2.0, 0.05);
  fixture_.advance(1s);
  EXPECT_EQ(last(*truths).velocity.v, 0.0);
}

TEST_F(SimulatorNodeTest, AnEmergencyStopOfAnySourceHoldsTheRobot) {
  start();
  const auto truths =
      fixture_.collect<coop_msgs::msg::GroundTruth>("ground_truth", Qos::kSensorStream);
  auto publisher = fixture_.tester().advertise<coop_msgs::msg::EmergencyStop>("emergency_stop",
                                                                              Qos::kStateLatched);
  coop_msgs::msg::EmergencyStop stop;
  stop.source("test");
  stop.engaged(true);
  publisher.publish(stop);
  fixture_.settle();
  drive({0.4, 0.0}, 1s);
  EXPECT_EQ(last(*truths).robot_in_world, (Pose2{2.0, 3.0, 0.0}));
  stop.engaged(false);
  publisher.publish(stop);
  fixture_.settle();
  drive({0.4, 0.0}, 1s);
  EXPECT_GT(last(*truths).robot_in_world.x, 2.1);
}

TEST_F(SimulatorNodeTest, AnEggFollowsTheGripper) {
  start();
  const auto truths =
      fixture_.collect<coop_msgs::msg::GroundTruth>("ground_truth", Qos::kSensorStream);
  auto gripper =
      fixture_.tester().advertise<coop_msgs::msg::GripperState>("gripper", Qos::kSensorStream);
  const auto hold = [&](bool suction, double x, double y, double z) {
    coop_msgs::msg::GripperState state;
    state.suction(suction);
    Pose3 tip = Pose3::Identity();
    tip.translation() << x, y, z;
    state.tip(conversions::to_msg(tip));
    gripper.publish(state);
    fixture_.advance(40ms);
    return last(*truths).eggs.at(0);
  };
  fixture_.advance(20ms);
  EXPECT_EQ(hold(true, 0.92, 0.0, 2 * world::kEggHalfWidth).state, world::EggState::kInGripper);
  EXPECT_NEAR(hold(true, 0.80, 0.0, 0.40).position.x(), 2.80, 1e-9);
  EXPECT_EQ(hold(true, 0.05, 0.12, 0.36).state, world::EggState::kInGripper);
  EXPECT_EQ(hold(false, 0.05, 0.12, 0.36).state, world::EggState::kCollected);
}

TEST_F(SimulatorNodeTest, AKilledSimulatorGoesOnWhereItWas) {
  start();
  const auto truths =
      fixture_.collect<coop_msgs::msg::GroundTruth>("ground_truth", Qos::kSensorStream);
  const auto clocks = fixture_.collect<rosgraph_msgs::msg::Clock>("clock", Qos::kEvent);
  drive({0.5, 0.2}, 3s);
  const world::GroundTruth before = last(*truths);
  const Time clock_before = *conversions::from_msg(clocks->back());
  fixture_.remove("simulator", /*crash=*/true);

  start();
  fixture_.advance(30ms);
  const world::GroundTruth after = last(*truths);
  // At most two ticks at 0.5 m/s, the watchdog braking, and time never runs back.
  EXPECT_GT(*conversions::from_msg(clocks->back()), clock_before);
  EXPECT_LE(after.stamp - before.stamp, 30ms);
  EXPECT_LT(distance(after.robot_in_world, before.robot_in_world), 0.02);
  EXPECT_GT(after.robot_in_world.x, 2.5);
}

TEST_F(SimulatorNodeTest, StartsAnewWhereTheJournalIsOfAnotherWorldOrNotWanted) {
  const auto position_after_restart = [&] {
    start();
    const auto truths =
        fixture_.collect<coop_msgs::msg::GroundTruth>("ground_truth", Qos::kSensorStream);
    fixture_.advance(50ms);
    const Pose2 pose = last(*truths).robot_in_world;
    fixture_.remove("simulator");
    return pose;
  };
  start();
  drive({0.5, 0.0}, 2s);
  fixture_.remove("simulator");
  EXPECT_GT(position_after_restart().x, 2.3);
  config_.resume = false;
  EXPECT_EQ(position_after_restart().x, 2.0);
  config_.resume = true;
  options_.seed = 6;
  EXPECT_EQ(position_after_restart().x, 2.0);
}

TEST_F(SimulatorNodeTest, RefusesWhatItCannotUseWithOneLine) {
  SimulatorConfig bad = config_;
  bad.world = "no/such.world.yaml";
  EXPECT_THAT([&] { SimulatorNode::check(bad); },
              ThrowsMessage<config::Error>(HasSubstr("no/such.world.yaml")));
  std::ofstream(config_.world) << "map: nowhere.yaml\n";
  EXPECT_THAT([&] { SimulatorNode::check(config_); },
              ThrowsMessage<std::exception>(HasSubstr("nowhere.yaml")));
  options_.sim_time = true;
  std::ofstream(config_.world) << "map: " << kSource << "/maps/duck_house.yaml\n"
                               << "robot_start: {x: 2.0, y: 3.0}\n";
  EXPECT_THAT([&] { start(); }, ThrowsMessage<std::runtime_error>(HasSubstr("master of time")));
}

}  // namespace
}  // namespace coop::simulator
