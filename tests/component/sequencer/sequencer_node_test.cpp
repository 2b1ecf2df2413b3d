#include "sequencer/node/sequencer_node.hpp"

#include <coop_msgs/msg/PickResult.h>
#include <gtest/gtest.h>
#include <nav_msgs/msg/OccupancyGrid.h>

#include <cmath>
#include <ctime>
#include <set>

#include "conversions/detections.hpp"
#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "conversions/time.hpp"
#include "support/component_fixture.hpp"
#include "support/temporary_folder.hpp"

namespace coop::sequencer {
namespace {

using namespace std::chrono_literals;
using coop_msgs::msg::MissionStatus;
using coop_msgs::msg::NavigationStatus;
using coop_msgs::msg::Pick;
using coop_msgs::msg::PickResult;
using geometry_msgs::msg::PoseStamped;
using runtime::Health;
using runtime::Qos;
namespace NavigationConstants = coop_msgs::msg::NavigationStatus_Constants;
namespace StatusConstants = coop_msgs::msg::MissionStatus_Constants;

/// Plays planner, arm and camera of a hall of 12 m x 12 m without obstacles; the robot is put where
/// it is sent.
class SequencerNodeTest : public testing::Test {
 protected:
  SequencerNodeTest() {
    config_.robot = std::string(COOP_SOURCE_DIR) + "/config/robot/egg_collector.urdf";
    config_.autostart = "collect";
    config_.waypoints = {{.name = "middle", .x = 6.0, .y = 6.0, .yaw = 0.0}};
    config_.mission.expected_eggs = 1;
    options_.run_dir = folder_.path();
    runtime::Node& tester = fixture_.tester();
    costmap_ = tester.advertise<nav_msgs::msg::OccupancyGrid>("global_costmap", Qos::kStateLatched);
    eggs_ = tester.advertise<vision_msgs::msg::Detection3DArray>("eggs", Qos::kEvent);
    navigation_ = tester.advertise<NavigationStatus>("navigation_status", Qos::kStateLatched);
    cameras_ =
        tester.advertise<sensor_msgs::msg::CameraInfo>("camera/camera_info", Qos::kSensorStream);
    results_ = tester.advertise<PickResult>("pick_result", Qos::kEvent);
    goals_ = fixture_.collect<PoseStamped>("goal_pose", Qos::kEvent);
    picks_ = fixture_.collect<Pick>("pick", Qos::kEvent);
    status_ = fixture_.collect<MissionStatus>("mission_status", Qos::kStateLatched);
  }

  void start() { fixture_.add<SequencerNode>("sequencer", config_, options_); }

  void publish_costmap() {
    costmap_.publish(conversions::to_msg(Stamped<OccupancyGrid>{
        fixture_.now(), "map", OccupancyGrid({120, 120, 0.1, {0, 0}}, kFree)}));
    fixture_.settle();
  }

  /// The robot tells where it is, every 50 ms.
  void live(Duration duration) {
    for (Duration done{0}; done < duration; done += 50ms) {
      fixture_.advance(50ms);
      fixture_.tester().publish_transform("map", "base_link", fixture_.now(), robot_);
      fixture_.settle();
    }
  }

  static Detection egg_at(const Eigen::Vector2d& place) {
    Detection detection;
    detection.class_id = "egg";
    detection.score = 0.9;
    detection.position = {place.x(), place.y(), 0.02};
    detection.covariance = Eigen::Matrix3d::Identity() * 1e-4;
    return detection;
  }
  /// One picture.
  void show(const std::string& frame, const std::vector<Detection>& eggs) {
    eggs_.publish(
        conversions::to_msg(Stamped<std::vector<Detection>>{fixture_.now(), frame, eggs}));
    live(200ms);
  }
  /// The camera sees an egg at (9, 6) three times, in base_link.
  void see_egg() {
    for (int i = 0; i < 3; ++i) {
      show("base_link", {egg_at(robot_.inverse() * Eigen::Vector2d{9.0, 6.0})});
    }
  }
  /// So many eggs in a square from the hall's corner on, that far apart, seen three times.
  void see_eggs(int count, double spacing) {
    const int side = static_cast<int>(std::lround(std::sqrt(count)));
    std::vector<Detection> eggs;
    for (int egg = 0; egg < count; ++egg) {
      eggs.push_back(egg_at({0.5 + spacing * (egg % side), 0.5 + spacing * (egg / side)}));
    }
    for (int i = 0; i < 3; ++i) show("map", eggs);
  }

  /// Pictures without an egg, of a camera above the working point that looks straight down.
  void see_nothing(int pictures) {
    const Pose3 camera = Eigen::Translation3d(0.92, 0, 1.0) *
                         Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX());
    fixture_.tester().publish_static_transform("base_link", "eye", camera);
    for (int i = 0; i < pictures; ++i) {
      cameras_.publish(conversions::to_msg(
          Stamped<Intrinsics>{fixture_.now(), "eye", {101, 101, 100, 100, 50, 50}}));
      show("eye", {});
    }
  }

  [[nodiscard]] static std::string id_of(const PoseStamped& goal) {
    return std::to_string(to_nanoseconds(conversions::from_msg(goal)->stamp));
  }
  void answer_goal(std::uint8_t state, const std::string& source = "dwa") {
    NavigationStatus status;
    status.source(source);
    status.goal_id(id_of(goals_->back()));
    status.state(state);
    if (state == NavigationConstants::ARRIVED)
      robot_ = conversions::from_msg(goals_->back())->value;
    live(200ms);
    navigation_.publish(status);
    live(1s);
  }
  void answer_pick(std::uint8_t result) {
    PickResult message;
    message.pick_id(picks_->back().pick_id());
    message.egg_id(picks_->back().egg_id());
    message.result(result);
    results_.publish(message);
    live(300ms);
  }
  /// Up to the moment at which the arm was ordered to pick.
  void come_to_the_pick() {
    start();
    publish_costmap();
    live(500ms);
    see_egg();
    live(500ms);
    ASSERT_FALSE(goals_->empty());
    answer_goal(NavigationConstants::ARRIVED);
    ASSERT_FALSE(picks_->empty());
  }
  [[nodiscard]] std::uint8_t phase() const { return status_->back().state(); }

  coop::test::TemporaryFolder folder_;
  coop::test::ComponentFixture fixture_;
  SequencerConfig config_;
  runtime::Options options_;
  Pose2 robot_{5.0, 6.0, 0.0};
  runtime::Publisher<nav_msgs::msg::OccupancyGrid> costmap_;
  runtime::Publisher<vision_msgs::msg::Detection3DArray> eggs_;
  runtime::Publisher<NavigationStatus> navigation_;
  runtime::Publisher<sensor_msgs::msg::CameraInfo> cameras_;
  runtime::Publisher<PickResult> results_;
  std::shared_ptr<std::vector<PoseStamped>> goals_;
  std::shared_ptr<std::vector<Pick>> picks_;
  std::shared_ptr<std::vector<MissionStatus>> status_;
};

TEST_F(SequencerNodeTest, WithoutAPoseOrACostmapItOrdersNothing) {
  start();
  fixture_.advance(3s);
  EXPECT_EQ(fixture_.node_of("sequencer").health(), Health::kDegraded);
  live(3s);
  EXPECT_EQ(fixture_.node_of("sequencer").health(), Health::kReady);
  EXPECT_TRUE(goals_->empty()) << "there is no costmap yet";
  publish_costmap();
  live(500ms);
  EXPECT_FALSE(goals_->empty());
}

TEST_F(SequencerNodeTest, AGoalWithoutAnswerIsToldAgainUnderItsStamp) {
  start();
  publish_costmap();
  live(5s);
  ASSERT_GE(goals_->size(), 2U);
  for (const PoseStamped& goal : *goals_) EXPECT_EQ(id_of(goal), id_of(goals_->front()));
}

TEST_F(SequencerNodeTest, AnEggIsSeenApproachedByEquationFourPickedAndAccountedFor) {
  come_to_the_pick();
  const Pose2 approach = conversions::from_msg(goals_->back())->value;
  EXPECT_NEAR(approach.x, 9.0 - 0.92, 0.05);
  EXPECT_NEAR(approach.y, 6.0, 0.05);
  EXPECT_EQ(phase(), StatusConstants::PICKING);
  EXPECT_EQ(picks_->back().header().frame_id(), "map");
  EXPECT_NEAR(picks_->back().position().x(), 9.0, 0.05);
  answer_pick(coop_msgs::msg::PickResult_Constants::PICKED);
  live(2s);
  EXPECT_EQ(phase(), StatusConstants::DONE);
  ASSERT_EQ(status_->back().eggs().size(), 1U);
  EXPECT_EQ(status_->back().eggs()[0].state(), coop_msgs::msg::EggStatus_Constants::PICKED);
}

TEST_F(SequencerNodeTest, AnArrivalOnlyThePlannerSpeaksOfIsNone) {
  start();
  publish_costmap();
  live(500ms);
  see_egg();
  live(500ms);
  answer_goal(NavigationConstants::ARRIVED, "global_planner");
  EXPECT_TRUE(picks_->empty());
}

TEST_F(SequencerNodeTest, AnEggThatIsNotThereWhereItWasSeenIsReportedMissing) {
  start();
  publish_costmap();
  live(500ms);
  see_egg();
  live(500ms);
  for (int look = 0; look < 2; ++look) {
    ASSERT_TRUE(picks_->empty());
    ASSERT_FALSE(goals_->empty());
    robot_ = conversions::from_msg(goals_->back())->value;  // there, and not yet told to be
    live(200ms);
    see_nothing(8);
    live(500ms);
  }
  EXPECT_TRUE(picks_->empty());
  ASSERT_EQ(status_->back().eggs().size(), 1U);
  EXPECT_EQ(status_->back().eggs()[0].state(), coop_msgs::msg::EggStatus_Constants::MISSING);
  EXPECT_EQ(status_->back().eggs()[0].reason(), "not there: 6 pictures of its place without it");
}

TEST_F(SequencerNodeTest, PauseTakesTheGoalBackByAGoalWithoutAFrame) {
  start();
  publish_costmap();
  live(500ms);
  ASSERT_FALSE(goals_->empty());
  const std::string id = id_of(goals_->back());
  auto orders = fixture_.tester().advertise<coop_msgs::msg::Mission>("mission", Qos::kStateLatched);
  coop_msgs::msg::Mission mission;
  mission.command(coop_msgs::msg::Mission_Constants::PAUSE);
  orders.publish(mission);
  live(500ms);
  EXPECT_EQ(phase(), StatusConstants::PAUSED);
  EXPECT_EQ(goals_->back().header().frame_id(), "");
  EXPECT_EQ(id_of(goals_->back()), id);
  const std::size_t told = goals_->size();
  NavigationStatus answer;
  answer.source("global_planner");
  answer.goal_id(id);
  answer.state(NavigationConstants::PREEMPTED);
  navigation_.publish(answer);
  live(5s);
  EXPECT_EQ(goals_->size(), told) << "answered: not taken back again";
}

TEST_F(SequencerNodeTest, KilledInMidPickItAsksForTheSamePickAgain) {
  come_to_the_pick();
  const std::string pick_id = picks_->back().pick_id();
  fixture_.remove("sequencer", true);
  const std::size_t told_before = picks_->size();
  start();
  publish_costmap();
  live(5s);
  ASSERT_GT(picks_->size(), told_before);
  std::set<std::string> ids;
  for (const Pick& pick : *picks_) ids.insert(pick.pick_id());
  EXPECT_EQ(ids, std::set<std::string>{pick_id});
  answer_pick(coop_msgs::msg::PickResult_Constants::PICKED);
  live(2s);
  EXPECT_EQ(phase(), StatusConstants::DONE);
}

TEST_F(SequencerNodeTest, KilledAfterTheEndItDoesNotBeginAnew) {
  come_to_the_pick();
  answer_pick(coop_msgs::msg::PickResult_Constants::PICKED);
  live(2s);
  ASSERT_EQ(phase(), StatusConstants::DONE);
  fixture_.remove("sequencer", true);
  const std::size_t told_before = goals_->size();
  start();
  publish_costmap();
  live(5s);
  EXPECT_EQ(goals_->size(), told_before);
  EXPECT_EQ(phase(), StatusConstants::DONE);
}

TEST_F(SequencerNodeTest, TenThousandEggsAreTakenInAndTheFirstIsDrivenTo) {
  start();
  publish_costmap();
  live(200ms);
  const std::clock_t begin = std::clock();
  see_eggs(10'000, 0.11);
  live(1s);
  ASSERT_FALSE(goals_->empty());
  EXPECT_EQ(status_->back().eggs().size(), 10'000U);
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 60.0);
}

TEST_F(SequencerNodeTest, EggsOnTopOfOneAnotherAreOne) {
  start();
  publish_costmap();
  live(200ms);
  see_eggs(10'000, 0.0);
  live(1s);
  ASSERT_FALSE(goals_->empty());
  EXPECT_EQ(status_->back().eggs().size(), 1U);
}

TEST_F(SequencerNodeTest, AMissionOfAnUnknownKindIsRefused) {
  config_.autostart = "none";
  start();
  publish_costmap();
  live(500ms);
  auto orders = fixture_.tester().advertise<coop_msgs::msg::Mission>("mission", Qos::kStateLatched);
  coop_msgs::msg::Mission mission;
  mission.mission_id("m1");
  mission.kind(coop_msgs::msg::Mission_Constants::CLEAN);
  orders.publish(mission);
  live(2s);
  EXPECT_TRUE(goals_->empty());
}

/// The same hall for a robot that cleans.
class CleaningNodeTest : public SequencerNodeTest {
 protected:
  CleaningNodeTest() {
    config_.robot = std::string(COOP_SOURCE_DIR) + "/config/robot/pen_cleaner.urdf";
    config_.autostart = "clean";
    config_.waypoints.clear();
    manure_ =
        fixture_.tester().advertise<vision_msgs::msg::Detection3DArray>("manure", Qos::kEvent);
  }
  /// Pictures with a heap at (9, 6), in map.
  void see_heap() {
    for (int i = 0; i < 12; ++i) {
      Detection heap;
      heap.class_id = "manure";
      heap.score = 1.0;
      heap.position = {9.0, 6.0, 0.0};
      heap.covariance = Eigen::Matrix3d::Identity() * 1e-4;
      manure_.publish(
          conversions::to_msg(Stamped<std::vector<Detection>>{fixture_.now(), "map", {heap}}));
      live(200ms);
    }
  }
  runtime::Publisher<vision_msgs::msg::Detection3DArray> manure_;
};

TEST_F(CleaningNodeTest, AHeapSeenFromAboveIsDrivenOverAndAccountedForWithoutAnArm) {
  start();
  publish_costmap();
  see_heap();
  ASSERT_FALSE(goals_->empty());
  const Pose2 goal = conversions::from_msg(goals_->back())->value;
  EXPECT_NEAR((goal.position() - Eigen::Vector2d(9.0, 6.0)).norm(), 0.41 - 0.05, 0.02)
      << "the blade ends beyond the heap";
  for (double back = 0.5; back >= 0.0; back -= 0.05) {
    robot_ = goal * Pose2{-back, 0.0, 0.0};
    live(100ms);
  }
  ASSERT_EQ(status_->back().eggs().size(), 1U);
  EXPECT_EQ(status_->back().eggs()[0].state(), coop_msgs::msg::EggStatus_Constants::PICKED);
  EXPECT_EQ(status_->back().kind(), coop_msgs::msg::Mission_Constants::CLEAN);
  EXPECT_TRUE(picks_->empty());
}

TEST_F(CleaningNodeTest, KilledOnTheWayItGoesOnToTheSameHeap) {
  start();
  publish_costmap();
  see_heap();
  ASSERT_EQ(status_->back().current_egg(), "heap1");
  fixture_.remove("sequencer", true);
  start();
  live(3s);
  EXPECT_EQ(status_->back().current_egg(), "heap1");
  EXPECT_EQ(status_->back().eggs().size(), 1U);
}

TEST_F(CleaningNodeTest, AnOrderToCollectIsRefusedByARobotThatCleans) {
  config_.autostart = "none";
  start();
  publish_costmap();
  coop_msgs::msg::Mission order;
  order.mission_id("eggs");
  order.kind(coop_msgs::msg::Mission_Constants::COLLECT);
  auto orders = fixture_.tester().advertise<coop_msgs::msg::Mission>("mission", Qos::kStateLatched);
  orders.publish(order);
  live(1s);
  EXPECT_EQ(status_->back().state(), StatusConstants::IDLE);
}

}  // namespace
}  // namespace coop::sequencer
