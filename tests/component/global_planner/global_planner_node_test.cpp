#include "global_planner/node/global_planner_node.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "conversions/detections.hpp"
#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "core/config/error.hpp"
#include "support/component_fixture.hpp"
#include "unit/global_planner/drawn_map.hpp"

namespace coop::global_planner {
namespace {

using namespace std::chrono_literals;
using coop_msgs::msg::NavigationStatus;
using geometry_msgs::msg::PoseStamped;
using nav_msgs::msg::OccupancyGrid;
using nav_msgs::msg::Path;
using runtime::Health;
using runtime::Qos;
namespace Constants = coop_msgs::msg::NavigationStatus_Constants;

const Pose2 kStart{1.2, 2.5, 0.0};
const Pose2 kGoal{4.0, 2.5, 0.0};

class GlobalPlannerNodeTest : public testing::Test {
 protected:
  GlobalPlannerNodeTest() {
    runtime::Node& tester = fixture_.tester();
    maps_ = tester.advertise<OccupancyGrid>("map", Qos::kStateLatched);
    goals_ = tester.advertise<PoseStamped>("goal_pose", Qos::kEvent);
    drivers_ = tester.advertise<NavigationStatus>("navigation_status", Qos::kStateLatched);
    plans_ = fixture_.collect<Path>("plan", Qos::kStateLatched);
    costmaps_ = fixture_.collect<OccupancyGrid>("global_costmap", Qos::kStateLatched);
    statuses_ = fixture_.collect<NavigationStatus>("navigation_status", Qos::kStateLatched);
    fixture_.add<GlobalPlannerNode>("global_planner", {});
  }

  void publish_map() {
    maps_.publish(conversions::to_msg(
        Stamped<coop::OccupancyGrid>{fixture_.now(), "map", test::draw_room()}));
  }
  /// Time goes on with the robot standing at `pose`.
  void stand(const Pose2& pose, int tenths) {
    for (int i = 0; i < tenths; ++i) {
      fixture_.tester().publish_transform("map", "odom", fixture_.now(), Pose2{});
      fixture_.tester().publish_transform("odom", "base_link", fixture_.now(), pose);
      fixture_.advance(100ms);
    }
  }
  std::string send_goal(const Pose2& pose, const std::string& frame = "map") {
    goals_.publish(conversions::to_msg(Stamped<Pose2>{fixture_.now(), frame, pose}));
    return std::to_string(to_nanoseconds(fixture_.now()));
  }
  void take_back(Time stamp) { goals_.publish(conversions::to_msg(Stamped<Pose2>{stamp, "", {}})); }
  [[nodiscard]] NavigationStatus last_status() const {
    for (auto i = statuses_->rbegin(); i != statuses_->rend(); ++i) {
      if (i->source() == "global_planner") return *i;
    }
    return {};
  }
  [[nodiscard]] Health health() { return fixture_.node_of("global_planner").health(); }

  test::ComponentFixture fixture_;
  runtime::Publisher<OccupancyGrid> maps_;
  runtime::Publisher<PoseStamped> goals_;
  runtime::Publisher<NavigationStatus> drivers_;
  std::shared_ptr<std::vector<Path>> plans_;
  std::shared_ptr<std::vector<OccupancyGrid>> costmaps_;
  std::shared_ptr<std::vector<NavigationStatus>> statuses_;
};

TEST_F(GlobalPlannerNodeTest, IsDegradedUntilMapAndPoseAreThere) {
  fixture_.advance(500ms);
  EXPECT_EQ(health(), Health::kDegraded);
  publish_map();
  fixture_.advance(500ms);
  EXPECT_EQ(health(), Health::kDegraded);
  stand(kStart, 3);
  EXPECT_EQ(health(), Health::kReady);
}

TEST_F(GlobalPlannerNodeTest, AnswersAGoalWithAPlanThatCarriesTheGoalsStamp) {
  publish_map();
  stand(kStart, 3);
  const std::string id = send_goal(kGoal);
  stand(kStart, 3);
  ASSERT_EQ(plans_->size(), 1U);
  const auto plan = conversions::from_msg(plans_->back());
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->frame_id, "map");
  EXPECT_EQ(std::to_string(to_nanoseconds(plan->stamp)), id);
  EXPECT_NEAR(distance(plan->value.front(), kStart), 0.0, 1e-6);
  EXPECT_NEAR(distance(plan->value.back(), kGoal), 0.0, 1e-6);
  EXPECT_EQ(last_status().state(), Constants::DRIVING);
  EXPECT_EQ(last_status().goal_id(), id);
}

TEST_F(GlobalPlannerNodeTest, TheCostmapIsLatchedAndNotRepeatedWithoutAChange) {
  publish_map();
  stand(kStart, 30);
  const std::size_t count = costmaps_->size();
  EXPECT_GE(count, 1U);
  stand(kStart, 50);
  EXPECT_EQ(costmaps_->size(), count);
  const auto late = fixture_.collect<OccupancyGrid>("global_costmap", Qos::kStateLatched);
  EXPECT_EQ(late->size(), 1U);
}

TEST_F(GlobalPlannerNodeTest, TellsThatTheGoalIsBlockedAndOffersAnother) {
  publish_map();
  stand(kStart, 3);
  send_goal({5.2, 2.5, 0.0});
  stand(kStart, 3);
  EXPECT_EQ(last_status().state(), Constants::FAILED);
  EXPECT_EQ(last_status().reason(), Constants::GOAL_BLOCKED);
  EXPECT_TRUE(last_status().has_alternative_goal());
}

TEST_F(GlobalPlannerNodeTest, TellsThatTheGoalIsOutside) {
  publish_map();
  stand(kStart, 3);
  send_goal({50.0, 2.5, 0.0});
  stand(kStart, 3);
  EXPECT_EQ(last_status().reason(), Constants::GOAL_OUTSIDE);
}

TEST_F(GlobalPlannerNodeTest, AGoalThatIsNotANumberIsRefusedAndThePlanInForceStands) {
  publish_map();
  stand(kStart, 3);
  const std::string id = send_goal(kGoal);
  stand(kStart, 3);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const Pose2& goal :
       {Pose2{kNaN, 2.5, 0.0}, Pose2{4.0, kInfinite, 0.0}, Pose2{4.0, 2.5, kNaN}}) {
    send_goal(goal);
    stand(kStart, 3);
  }
  EXPECT_EQ(plans_->size(), 1U);
  EXPECT_EQ(last_status().state(), Constants::DRIVING);
  EXPECT_EQ(last_status().goal_id(), id);
  EXPECT_EQ(health(), Health::kReady);
}

TEST_F(GlobalPlannerNodeTest, MalformedMapsAreRefusedAndTheOneBeforeStands) {
  OccupancyGrid good =
      conversions::to_msg(Stamped<coop::OccupancyGrid>{fixture_.now(), "map", test::draw_room()});
  OccupancyGrid empty = good;
  empty.info().width(0);
  empty.data().clear();
  OccupancyGrid shorter = good;
  shorter.data().resize(good.data().size() / 2);
  OccupancyGrid flat = good;
  flat.info().resolution(0.0F);
  OccupancyGrid nowhere = good;
  nowhere.info().origin().position().x(std::numeric_limits<double>::quiet_NaN());
  OccupancyGrid absurd = good;
  absurd.info().width(4'000'000'000U);
  absurd.info().height(4'000'000'000U);
  const std::vector<OccupancyGrid> malformed{empty, shorter, flat, nowhere, absurd};
  for (const OccupancyGrid& map : malformed) {
    maps_.publish(map);
    stand(kStart, 2);
    EXPECT_EQ(health(), Health::kDegraded) << "a malformed map was taken";
  }
  maps_.publish(good);
  stand(kStart, 3);
  for (const OccupancyGrid& map : malformed) {
    maps_.publish(map);
    stand(kStart, 2);
  }
  send_goal(kGoal);
  stand(kStart, 3);
  EXPECT_EQ(last_status().state(), Constants::DRIVING);
}

TEST_F(GlobalPlannerNodeTest, MoreAnimalsThanAnyPenHoldsAreRefused) {
  publish_map();
  auto animals =
      fixture_.tester().advertise<vision_msgs::msg::Detection3DArray>("animals", Qos::kEvent);
  Detection pig;
  pig.class_id = "pig";
  pig.position = {2.5, 2.5, 0.2};
  pig.size = {0.4, 0.4, 0.4};
  animals.publish(conversions::to_msg(
      Stamped<std::vector<Detection>>{fixture_.now(), "map", std::vector<Detection>(10'000, pig)}));
  stand(kStart, 3);
  send_goal(kGoal);
  stand(kStart, 3);
  EXPECT_EQ(last_status().state(), Constants::DRIVING);
  const auto plan = conversions::from_msg(plans_->back());
  ASSERT_TRUE(plan);
  for (const Pose2& pose : plan->value) EXPECT_NEAR(pose.y, 2.5, 0.2) << "there is no pig";
}

TEST_F(GlobalPlannerNodeTest, AGoalWithoutAFrameTakesTheGoalOfItsStampBack) {
  publish_map();
  stand(kStart, 3);
  const std::string id = send_goal(kGoal);
  const Time stamp = fixture_.now();
  stand(kStart, 3);
  take_back(stamp - 1s);
  stand(kStart, 3);
  EXPECT_EQ(last_status().state(), Constants::DRIVING) << "that was another goal's stamp";
  take_back(stamp);
  stand(kStart, 3);
  ASSERT_EQ(plans_->size(), 2U);
  EXPECT_TRUE(plans_->back().poses().empty());
  EXPECT_EQ(last_status().state(), Constants::PREEMPTED);
  EXPECT_EQ(last_status().reason(), Constants::CANCELLED);
  EXPECT_EQ(last_status().goal_id(), id);
}

TEST_F(GlobalPlannerNodeTest, WithoutFrameAndStampWhicheverGoalIsInForceIsTakenBack) {
  publish_map();
  stand(kStart, 3);
  const std::string id = send_goal(kGoal);
  stand(kStart, 3);
  take_back(Time{});
  stand(kStart, 3);
  EXPECT_TRUE(plans_->back().poses().empty());
  EXPECT_EQ(last_status().reason(), Constants::CANCELLED);
  EXPECT_EQ(last_status().goal_id(), id);
}

TEST_F(GlobalPlannerNodeTest, RefusesAGoalInAnotherFrame) {
  publish_map();
  stand(kStart, 3);
  send_goal(kGoal, "odom");
  stand(kStart, 3);
  EXPECT_TRUE(plans_->empty());
}

TEST_F(GlobalPlannerNodeTest, PlansAnewWhenTheDriverIsStuck) {
  publish_map();
  stand(kStart, 3);
  const std::string id = send_goal(kGoal);
  stand(kStart, 3);
  NavigationStatus driver;
  driver.source("dwa");
  driver.goal_id(id);
  driver.state(Constants::DRIVING);
  driver.reason(Constants::STUCK);
  drivers_.publish(driver);
  stand(kStart, 3);
  EXPECT_EQ(plans_->size(), 2U);
}

TEST_F(GlobalPlannerNodeTest, WithoutAPoseTheGoalFailsAndSaysWhy) {
  publish_map();
  send_goal(kGoal);
  fixture_.advance(1s);
  EXPECT_EQ(last_status().state(), Constants::PLANNING);
  EXPECT_EQ(last_status().reason(), Constants::NO_POSE);
  fixture_.advance(11s);
  EXPECT_EQ(last_status().state(), Constants::FAILED);
}

TEST(GlobalPlannerNodeCheck, RefusesARobotThatIsNotThere) {
  GlobalPlannerNodeConfig config;
  config.robot = "no/such.urdf";
  EXPECT_ANY_THROW(GlobalPlannerNode::check(config));
}

TEST_F(GlobalPlannerNodeTest, AnAnimalOnTheWayIsPlannedAround) {
  auto animals =
      fixture_.tester().advertise<vision_msgs::msg::Detection3DArray>("animals", Qos::kEvent);
  publish_map();
  stand(kStart, 3);
  Detection pig;
  pig.class_id = "pig";
  pig.position = {2.6, 2.5, 0.2};
  pig.size = {0.3, 0.3, 0.4};
  animals.publish(
      conversions::to_msg(Stamped<std::vector<Detection>>{fixture_.now(), "map", {pig}}));
  animals.publish(conversions::to_msg(
      Stamped<std::vector<Detection>>{fixture_.now() + 1ms, "odom", {}}));  // refused
  send_goal(kGoal);
  stand(kStart, 3);
  ASSERT_FALSE(plans_->empty());
  double widest = 0.0;
  for (const auto& pose : plans_->back().poses()) {
    widest = std::max(widest, std::abs(pose.pose().position().y() - 2.5));
  }
  EXPECT_GT(widest, 0.3);
}

}  // namespace
}  // namespace coop::global_planner
