#include "arm_driver/node/arm_driver_node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "conversions/geometry.hpp"
#include "conversions/time.hpp"
#include "core/config/config.hpp"
#include "simulator/node/simulator_node.hpp"
#include "support/component_fixture.hpp"
#include "support/temporary_folder.hpp"

namespace coop::arm_driver {
namespace {

using runtime::Qos;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// The driver over DDS-less topics, with the simulator as its world: an egg lies before the robot.
class ArmDriverNodeTest : public testing::Test {
 protected:
  ArmDriverNodeTest() {
    fixture_.set_time(Time{});  // as the simulator's clock begins
    results_ = fixture_.collect<coop_msgs::msg::PickResult>("pick_result", Qos::kEvent);
    pick_ = fixture_.tester().advertise<coop_msgs::msg::Pick>("pick", Qos::kEvent);
    stop_ = fixture_.tester().advertise<coop_msgs::msg::EmergencyStop>("emergency_stop",
                                                                       Qos::kStateLatched);
  }

  void start_driver() {
    ArmDriverConfig config;
    config.robot = kRobot;
    runtime::Options options;
    options.run_dir = folder_.path();
    fixture_.add<ArmDriverNode>("arm_driver", config, options);
  }

  /// `egg`: before the robot, in base_link.
  void start_world(const Eigen::Vector2d& egg) {
    const auto file = folder_.path() / "one_egg.world.yaml";
    std::ofstream(file) << "map: " << COOP_SOURCE_DIR << "/maps/duck_house.yaml\n"
                        << "robot_start: {x: 1.6, y: 2.1, yaw: 0.0}\n"
                        << "eggs: [{id: egg_1, x: " << 1.6 + egg.x() << ", y: " << 2.1 + egg.y()
                        << "}]\n";
    simulator::SimulatorConfig config;
    config.world = file;
    config.robot = kRobot;
    runtime::Options options;
    options.run_dir = folder_.path();
    fixture_.add<simulator::SimulatorNode>("simulator", config, options);
    fixture_.tester().subscribe<coop_msgs::msg::GroundTruth>(
        "ground_truth", Qos::kSensorStream,
        [this](const coop_msgs::msg::GroundTruth& truth) { egg_ = truth.eggs().at(0).state(); });
  }

  void order(const std::string& pick_id, const std::string& frame, const Eigen::Vector3d& egg) {
    coop_msgs::msg::Pick message;
    message.header(conversions::to_header(fixture_.now(), frame));
    message.pick_id(pick_id);
    message.egg_id("egg_1");
    message.position(conversions::to_point_msg(egg));
    pick_.publish(message);
    fixture_.settle();
  }

  void set_stop(const std::string& source, bool engaged) {
    coop_msgs::msg::EmergencyStop message;
    message.engaged(engaged);
    message.source(source);
    stop_.publish(message);
    fixture_.settle();
  }

  bool run_to_result(Duration limit = seconds(30)) {
    const std::size_t before = results_->size();
    return fixture_.advance_until([&] { return results_->size() > before; }, limit);
  }
  bool run_to_egg(std::uint8_t state) {
    return fixture_.advance_until([&] { return egg_ == state; }, seconds(20));
  }

  static constexpr std::uint8_t kOnFloor = 0;
  static constexpr std::uint8_t kInGripper = 1;
  static constexpr std::uint8_t kCollected = 2;
  const std::string kRobot = std::string(COOP_SOURCE_DIR) + "/config/robot/egg_collector.urdf";

  coop::test::TemporaryFolder folder_;
  coop::test::ComponentFixture fixture_;
  std::shared_ptr<std::vector<coop_msgs::msg::PickResult>> results_;
  runtime::Publisher<coop_msgs::msg::Pick> pick_;
  runtime::Publisher<coop_msgs::msg::EmergencyStop> stop_;
  std::uint8_t egg_ = kOnFloor;
};

TEST_F(ArmDriverNodeTest, PutsTheSimulatorsEggIntoTheBasketWithinEightSeconds) {
  start_world({0.92, 0.0});
  start_driver();
  fixture_.advance(seconds(1));
  const Time start = fixture_.now();
  order("p1", "base_link", {0.92, 0.0, 0.0225});
  ASSERT_TRUE(run_to_result());
  EXPECT_EQ(results_->at(0).pick_id(), "p1");
  EXPECT_EQ(results_->at(0).egg_id(), "egg_1");
  EXPECT_EQ(results_->at(0).result(), coop_msgs::msg::PickResult_Constants::PICKED)
      << results_->at(0).detail();
  EXPECT_EQ(egg_, kCollected);
  EXPECT_LT(to_seconds(fixture_.now() - start), 8.5);
}

TEST_F(ArmDriverNodeTest, FindsAnEggFourCentimetresOff) {
  start_world({0.93, 0.04});
  start_driver();
  fixture_.advance(seconds(1));
  order("p1", "base_link", {0.92, 0.0, 0.0225});
  ASSERT_TRUE(run_to_result());
  EXPECT_EQ(results_->at(0).result(), coop_msgs::msg::PickResult_Constants::PICKED);
  EXPECT_EQ(egg_, kCollected);
}

TEST_F(ArmDriverNodeTest, TakesOrdersInOdomByTheRobotsPoseThere) {
  start_world({0.92, 0.0});
  start_driver();
  fixture_.advance(seconds(1));
  order("p1", "odom", {0.92, 0.0, 0.0225});  // odometry begins at the start pose
  ASSERT_TRUE(run_to_result());
  EXPECT_EQ(egg_, kCollected) << results_->at(0).detail();
}

TEST_F(ArmDriverNodeTest, WithoutTheTransformAbortsAndSaysWhichIsMissing) {
  start_world({0.92, 0.0});
  start_driver();
  fixture_.advance(seconds(1));
  order("p1", "map", {2.52, 2.1, 0.0225});
  fixture_.advance(milliseconds(500));
  order("p1", "map", {2.52, 2.1, 0.0225});
  ASSERT_TRUE(run_to_result(seconds(4)));
  fixture_.advance(seconds(3));
  ASSERT_EQ(results_->size(), 1U) << "said twice, answered once";
  EXPECT_EQ(results_->at(0).result(), coop_msgs::msg::PickResult_Constants::ABORTED);
  EXPECT_THAT(results_->at(0).detail(), testing::HasSubstr("map"));
}

TEST_F(ArmDriverNodeTest, KilledWithTheEggInTheGripperFinishesAfterTheRestart) {
  start_world({0.92, 0.0});
  start_driver();
  fixture_.advance(seconds(1));
  order("p1", "base_link", {0.92, 0.0, 0.0225});
  ASSERT_TRUE(run_to_egg(kInGripper));
  fixture_.advance(milliseconds(1500));
  fixture_.remove("arm_driver", true);
  fixture_.advance(seconds(2));
  EXPECT_EQ(egg_, kInGripper) << "the arm holds on";
  start_driver();
  ASSERT_TRUE(run_to_result());
  EXPECT_EQ(results_->at(0).result(), coop_msgs::msg::PickResult_Constants::PICKED);
  EXPECT_EQ(egg_, kCollected);
}

TEST_F(ArmDriverNodeTest, KilledOnTheWayDownPicksWhenTheOrderIsSaidAgain) {
  start_world({0.92, 0.0});
  start_driver();
  fixture_.advance(seconds(1));
  order("p1", "base_link", {0.92, 0.0, 0.0225});
  fixture_.advance(milliseconds(1800));
  fixture_.remove("arm_driver", true);
  fixture_.advance(seconds(1));
  start_driver();
  order("p1", "base_link", {0.92, 0.0, 0.0225});
  ASSERT_TRUE(run_to_result());
  EXPECT_EQ(results_->at(0).result(), coop_msgs::msg::PickResult_Constants::PICKED);
  EXPECT_EQ(egg_, kCollected);
}

TEST_F(ArmDriverNodeTest, RepeatsAResultAfterARestart) {
  start_world({0.92, 0.0});
  start_driver();
  fixture_.advance(seconds(1));
  order("p1", "base_link", {0.92, 0.0, 0.0225});
  ASSERT_TRUE(run_to_result());
  fixture_.remove("arm_driver", true);
  start_driver();
  order("p1", "no_such_frame", {9.0, 9.0, 0.0});  // where it lay plays no part any more
  ASSERT_TRUE(run_to_result(seconds(1)));
  EXPECT_EQ(results_->at(1).result(), coop_msgs::msg::PickResult_Constants::PICKED);
}

TEST_F(ArmDriverNodeTest, StaysFrozenWhileAnySourceHasTheStopEngaged) {
  start_world({0.92, 0.0});
  start_driver();
  fixture_.advance(seconds(1));
  const auto states =
      fixture_.collect<sensor_msgs::msg::JointState>("joint_states", Qos::kSensorStream);
  order("p1", "base_link", {0.92, 0.0, 0.0225});
  fixture_.advance(seconds(1));
  set_stop("person", true);
  set_stop("dashboard", true);
  fixture_.advance(milliseconds(200));
  const auto frozen = states->back().position();
  fixture_.advance(seconds(5));
  set_stop("person", false);
  fixture_.advance(seconds(5));
  EXPECT_EQ(states->back().position(), frozen);
  EXPECT_TRUE(results_->empty());
  set_stop("dashboard", false);
  ASSERT_TRUE(run_to_result());
  EXPECT_EQ(results_->at(0).result(), coop_msgs::msg::PickResult_Constants::PICKED);
}

TEST_F(ArmDriverNodeTest, OrdersThatAreNoneAreRefused) {
  start_world({0.92, 0.0});
  start_driver();
  fixture_.advance(seconds(1));
  order("", "base_link", {0.92, 0.0, 0.0});
  order("p1", "base_link", {std::nan(""), 0.0, 0.0});
  order("p2", "", {0.92, 0.0, 0.0});
  fixture_.advance(seconds(3));
  ASSERT_EQ(results_->size(), 2U);
  for (const auto& result : *results_) {
    EXPECT_EQ(result.result(), coop_msgs::msg::PickResult_Constants::ABORTED);
  }
  EXPECT_EQ(egg_, kOnFloor);
}

TEST_F(ArmDriverNodeTest, WithoutTheSimulatorSaysSoAndStillTellsItsState) {
  start_driver();
  const auto states =
      fixture_.collect<sensor_msgs::msg::JointState>("joint_states", Qos::kSensorStream);
  const auto gripper =
      fixture_.collect<coop_msgs::msg::GripperState>("gripper", Qos::kSensorStream);
  EXPECT_EQ(fixture_.node_of("arm_driver").health(), runtime::Health::kReady);
  fixture_.advance(seconds(2));
  EXPECT_EQ(fixture_.node_of("arm_driver").health(), runtime::Health::kDegraded);
  EXPECT_NEAR(static_cast<double>(states->size()), 50.0, 2.0) << "25 Hz";
  EXPECT_EQ(states->back().name().size(), 6U);
  EXPECT_GE(gripper->size(), 9U);
  EXPECT_FALSE(gripper->back().suction());
  start_world({0.92, 0.0});
  fixture_.advance(milliseconds(200));
  EXPECT_EQ(fixture_.node_of("arm_driver").health(), runtime::Health::kReady);
}

TEST_F(ArmDriverNodeTest, TellsTheGripperFiftyTimesASecondAndItsLinksTenTimesWhileItMoves) {
  start_world({0.92, 0.0});
  start_driver();
  fixture_.advance(seconds(1));
  const auto gripper =
      fixture_.collect<coop_msgs::msg::GripperState>("gripper", Qos::kSensorStream);
  int link_messages = 0;
  fixture_.tester().subscribe<tf2_msgs::msg::TFMessage>(
      "tf", Qos::kEvent, [&](const tf2_msgs::msg::TFMessage& message) {
        const auto& first = message.transforms().at(0);
        if (first.header().frame_id() == "arm_base_link") ++link_messages;
      });
  fixture_.settle();
  gripper->clear();
  link_messages = 0;
  fixture_.advance(seconds(1));
  EXPECT_NEAR(static_cast<double>(gripper->size()), 5.0, 1.0);
  EXPECT_EQ(link_messages, 0);
  gripper->clear();
  order("p1", "base_link", {0.92, 0.0, 0.0225});
  fixture_.advance(seconds(2));
  EXPECT_NEAR(static_cast<double>(gripper->size()), 100.0, 3.0);
  EXPECT_NEAR(link_messages, 20.0, 2.0);
}

TEST_F(ArmDriverNodeTest, TellsTheCupsPlaceByTransformsAsByTheGripperTopic) {
  (void)fixture_.tester().transforms();
  start_driver();
  const auto gripper =
      fixture_.collect<coop_msgs::msg::GripperState>("gripper", Qos::kSensorStream);
  const auto description =
      fixture_.collect<std_msgs::msg::String>("robot_description", Qos::kStateLatched);
  fixture_.advance(milliseconds(300));
  const auto& transforms = fixture_.tester().transforms();
  const auto stamp = transforms.newest_stamp("base_link", "suction_cup_link");
  ASSERT_TRUE(stamp);
  const auto cup = transforms.lookup("base_link", "suction_cup_link", *stamp);
  ASSERT_TRUE(cup);
  const auto tip = conversions::pose3_from_msg(gripper->back().tip());
  ASSERT_TRUE(tip);
  EXPECT_TRUE(cup->isApprox(*tip, 1e-6));
  ASSERT_EQ(description->size(), 1U);
  EXPECT_THAT(description->at(0).data(), testing::HasSubstr("<robot name=\"egg_collector\">"));
}

TEST_F(ArmDriverNodeTest, ShippedConfigurationIsSound) {
  auto config = config::Document::load(std::string(COOP_SOURCE_DIR) + "/config/arm_driver.yaml")
                    .read<ArmDriverConfig>();
  config.robot = kRobot;
  EXPECT_NO_THROW(ArmDriverNode::check(config));
  config.robot = "no_such.urdf";
  EXPECT_THROW(ArmDriverNode::check(config), std::runtime_error);
  config.robot = kRobot;
  config.motion.home = {9, 9, 9, 9, 9, 9};
  EXPECT_THROW(ArmDriverNode::check(config), std::runtime_error);
}

TEST_F(ArmDriverNodeTest, IsReadyAgainOnceItsJournalCanBeWrittenAgain) {
  const auto in_the_way = folder_.path() / "arm_driver.journal";
  start_world({0.92, 0.0});
  start_driver();
  fixture_.advance(seconds(1));
  std::filesystem::create_directories(in_the_way / "full");
  order("p1", "base_link", {0.92, 0.0, 0.0225});
  ASSERT_TRUE(run_to_result());
  EXPECT_EQ(fixture_.node_of("arm_driver").health(), runtime::Health::kDegraded);
  std::filesystem::remove_all(in_the_way);
  fixture_.advance(seconds(1));
  EXPECT_EQ(fixture_.node_of("arm_driver").health(), runtime::Health::kReady);
  EXPECT_TRUE(std::filesystem::is_regular_file(in_the_way));
}

TEST_F(ArmDriverNodeTest, SpoiltJournalDoesNotStopIt) {
  std::ofstream(folder_.path() / "arm_driver.journal") << "{\"format\": \"coop pi";
  start_world({0.92, 0.0});
  start_driver();
  fixture_.advance(seconds(1));
  order("p1", "base_link", {0.92, 0.0, 0.0225});
  ASSERT_TRUE(run_to_result());
  EXPECT_EQ(results_->at(0).result(), coop_msgs::msg::PickResult_Constants::PICKED);
}

}  // namespace
}  // namespace coop::arm_driver
