#include "referee/node/referee_node.hpp"

#include <gtest/gtest.h>

#include "conversions/geometry.hpp"
#include "conversions/time.hpp"
#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "core/world/shapes.hpp"
#include "support/component_fixture.hpp"
#include "support/simulated_world.hpp"
#include "support/temporary_folder.hpp"

namespace coop::referee {
namespace {

using namespace std::chrono_literals;
using coop_msgs::msg::MissionStatus;
using coop_msgs::msg::NavigationStatus;
using geometry_msgs::msg::PoseStamped;
using runtime::Qos;
namespace EggState = coop_msgs::msg::EggStatus_Constants;
namespace MissionState = coop_msgs::msg::MissionStatus_Constants;

/// The simulator, localisation, the mission and the driver, played by the test.
class RefereeNodeTest : public ::testing::Test {
 protected:
  RefereeNodeTest() {
    config_.robot = std::string(COOP_SOURCE_DIR) + "/config/robot/egg_collector.urdf";
    mission_ = fixture_.tester().advertise<MissionStatus>("mission_status", Qos::kStateLatched);
    navigation_ =
        fixture_.tester().advertise<NavigationStatus>("navigation_status", Qos::kStateLatched);
    goal_ = fixture_.tester().advertise<PoseStamped>("goal_pose", Qos::kEvent);
    simulator_.world.robot_start = {1.0, 1.5, 0.0};
    simulator_.world.eggs = {{"egg_1", {4.0, 1.5, world::kEggHalfWidth}}};
    simulator_.scene.eggs = simulator_.world.eggs;
    simulator_.scene.robot_in_world = simulator_.world.robot_start;
  }
  void start() {
    runtime::Options options;
    options.run_dir = folder_.path();
    options.seed = 9;
    fixture_.add<RefereeNode>("referee", config_, options);
    simulator_.publish_world();
    stand(200ms);
  }
  /// The robot stands, and believes to stand `ahead` metres farther than it does.
  void stand(Duration duration, double ahead = 0.0) {
    for (Duration done{0}; done < duration; done += 20ms) {
      Pose2 in_map = simulator_.world.robot_start.inverse() * simulator_.scene.robot_in_world;
      in_map.x += ahead;
      fixture_.tester().publish_transform("map", "odom", fixture_.now() + 20ms, in_map);
      fixture_.tester().publish_transform("odom", "base_link", fixture_.now() + 20ms, Pose2{});
      simulator_.publish_truth(20ms);
    }
  }
  void tell(std::uint8_t mission, std::uint8_t egg, int tries, const std::string& reason = "") {
    MissionStatus status;
    status.state(mission);
    coop_msgs::msg::EggStatus one;
    one.egg_id("egg1");
    one.state(egg);
    one.attempts(static_cast<std::uint8_t>(tries));
    one.reason(reason);
    one.position().x(3.0);
    status.eggs().push_back(one);
    mission_.publish(status);
    fixture_.settle();
  }
  void set_out() {
    PoseStamped goal =
        conversions::to_msg(Stamped<Pose2>{time_from_seconds(5.0), "map", {2.08, 0, 0}});
    goal_.publish(goal);
    tell(MissionState::DRIVING, EggState::APPROACHING, 1);
  }
  void arrive() {
    NavigationStatus status;
    status.source("dwa");
    status.goal_id("5000000000");
    status.state(coop_msgs::msg::NavigationStatus_Constants::ARRIVED);
    navigation_.publish(status);
    fixture_.settle();
  }
  [[nodiscard]] CsvTable table(const std::string& file = "attempts.csv") const {
    return parse_csv(read_file(folder_.path() / file));
  }
  [[nodiscard]] std::string field(const CsvTable& table, const std::string& column) const {
    return table.rows.at(0).at(table.column(column));
  }

  test::TemporaryFolder folder_;
  RefereeNodeConfig config_;
  test::ComponentFixture fixture_;
  test::SimulatedWorld simulator_{fixture_};
  runtime::Publisher<MissionStatus> mission_;
  runtime::Publisher<NavigationStatus> navigation_;
  runtime::Publisher<PoseStamped> goal_;
};

TEST_F(RefereeNodeTest, AnAttemptIsOnDiskAsSoonAsItIsOverAndTheRunEndsWithTheMission) {
  start();
  set_out();
  simulator_.scene.robot_in_world = {3.08, 1.5, 0.0};
  stand(200ms);
  arrive();
  stand(200ms);
  EXPECT_TRUE(table().rows.empty());
  simulator_.scene.eggs[0].state = world::EggState::kCollected;
  stand(200ms);
  tell(MissionState::ORDERING, EggState::PICKED, 1);
  stand(200ms);
  const CsvTable after = table();
  ASSERT_EQ(after.rows.size(), 1U);
  EXPECT_EQ(field(after, "seed"), "9");
  EXPECT_EQ(field(after, "egg"), "egg_1");
  EXPECT_EQ(field(after, "outcome"), "success");
  EXPECT_EQ(field(after, "picked"), "1");
  EXPECT_FALSE(fixture_.node_of("referee").wants_to_end());
  tell(MissionState::DONE, EggState::PICKED, 1);
  stand(200ms);
  const CsvTable legs = table("legs.csv");
  ASSERT_EQ(legs.rows.size(), 1U);
  EXPECT_EQ(field(legs, "reached"), "1");
  EXPECT_EQ(field(legs, "path_length"), "2.0800");
  EXPECT_TRUE(fixture_.node_of("referee").wants_to_end());
  EXPECT_EQ(fixture_.node_of("referee").exit_code(), 0);
  EXPECT_EQ(table().rows.size(), 1U);
}

TEST_F(RefereeNodeTest, ARobotThatIsNotWhereItThinksMissesByAnErrorOfLocalisation) {
  start();
  set_out();
  simulator_.scene.robot_in_world = {2.7, 1.5, 0.0};
  stand(400ms, 0.38);
  arrive();
  stand(400ms, 0.38);
  tell(MissionState::ORDERING, EggState::FAILED, 1, "no vacuum");
  stand(200ms, 0.38);
  const CsvTable after = table();
  ASSERT_EQ(after.rows.size(), 1U);
  EXPECT_EQ(field(after, "outcome"), "failure");
  EXPECT_EQ(field(after, "cause"), "localisation error");
  EXPECT_EQ(field(after, "deviation_x"), "0.3800");
  EXPECT_EQ(field(after, "localisation_error"), "0.3800");
  EXPECT_EQ(field(after, "detail"), "no vacuum");
}

TEST_F(RefereeNodeTest, TheTimeLimitEndsTheRunAndAccountsForEveryEgg) {
  config_.time_limit = 1.0;
  start();
  tell(MissionState::SEARCHING, EggState::SEEN, 0);
  stand(1500ms);
  EXPECT_TRUE(fixture_.node_of("referee").wants_to_end());
  const CsvTable after = table();
  ASSERT_EQ(after.rows.size(), 1U);
  EXPECT_EQ(field(after, "cause"), "not tried");
}

TEST_F(RefereeNodeTest, AStopWritesWhatIsOpen) {
  start();
  set_out();
  stand(200ms);
  fixture_.remove("referee");
  const CsvTable after = table();
  ASSERT_EQ(after.rows.size(), 1U);
  EXPECT_EQ(field(after, "cause"), "mission ended");
}

TEST_F(RefereeNodeTest, OfARobotThatCleansHeapsAreJudgedByWhereItsBladeWas) {
  config_.robot = std::string(COOP_SOURCE_DIR) + "/config/robot/pen_cleaner.urdf";
  simulator_.world.eggs.clear();
  simulator_.scene.eggs.clear();
  simulator_.world.heaps = {{"near", {1.8, 1.5}, 0.06}, {"far", {4.0, 1.5}, 0.06}};
  start();
  tell(MissionState::DRIVING, EggState::APPROACHING, 1);
  for (int step = 0; step < 25; ++step) {
    simulator_.scene.robot_in_world.x += 0.02;
    stand(20ms);
  }
  tell(MissionState::DONE, EggState::PICKED, 1);
  stand(200ms);
  const CsvTable heaps = table("heaps.csv");
  ASSERT_EQ(heaps.rows.size(), 2U);
  EXPECT_EQ(field(heaps, "heap"), "near");
  EXPECT_EQ(field(heaps, "covered"), "1");
  EXPECT_EQ(heaps.rows[1].at(heaps.column("covered")), "0");
  EXPECT_TRUE(table().rows.empty()) << "heaps are no eggs";
  EXPECT_TRUE(fixture_.node_of("referee").wants_to_end());
}

}  // namespace
}  // namespace coop::referee
