#include "global_planner/node/global_planner_node.hpp"

#include "conversions/detections.hpp"
#include "conversions/geometry.hpp"
#include "conversions/mission.hpp"
#include "conversions/navigation.hpp"
#include "conversions/time.hpp"
#include "runtime/scan_subscription.hpp"

namespace coop::global_planner {

using coop_msgs::msg::NavigationStatus;
using runtime::Qos;
namespace Constants = coop_msgs::msg::NavigationStatus_Constants;

namespace {

constexpr auto kUpdatePeriod = std::chrono::milliseconds(100);
constexpr auto kCostmapPeriod = std::chrono::seconds(1);
constexpr auto kPatience = std::chrono::seconds(1);
constexpr auto kPoseAge = std::chrono::seconds(1);

std::uint8_t to_state(PlannerState state) {
  switch (state) {
    case PlannerState::kIdle:
      return Constants::IDLE;
    case PlannerState::kPlanning:
      return Constants::PLANNING;
    case PlannerState::kPlanned:
      return Constants::DRIVING;
    case PlannerState::kFailed:
      return Constants::FAILED;
    case PlannerState::kCancelled:
      return Constants::PREEMPTED;
  }
  return Constants::IDLE;
}

std::uint8_t to_reason(PlannerReason reason) {
  switch (reason) {
    case PlannerReason::kNone:
      return Constants::NONE;
    case PlannerReason::kNoMap:
      return Constants::NO_MAP;
    case PlannerReason::kNoPose:
      return Constants::NO_POSE;
    case PlannerReason::kStartBlocked:
      return Constants::START_BLOCKED;
    case PlannerReason::kGoalBlocked:
      return Constants::GOAL_BLOCKED;
    case PlannerReason::kGoalOutside:
      return Constants::GOAL_OUTSIDE;
    case PlannerReason::kGoalUnknown:
      return Constants::GOAL_UNKNOWN_SPACE;
    case PlannerReason::kNoPath:
      return Constants::NO_PATH;
  }
  return Constants::NONE;
}

}  // namespace

void GlobalPlannerNodeConfig::describe(config::Fields& fields) {
  fields.text("robot", robot, {.help = "URDF of the robot: footprint, turning circle"});
  fields.number("egg_radius", egg_radius,
                {.unit = "m", .help = "kept clear around an egg on the floor", .min = 0, .max = 1});
  planner.describe(fields);
}

void GlobalPlannerNodeConfig::validate() const {
  planner.path.validate();
}

GlobalPlannerNode::GlobalPlannerNode(runtime::Node& node, const Config& config)
    : node_(node),
      config_(config),
      planner_(config.planner, robot::RobotModel::load(config.robot).footprint(),
               robot::RobotModel::load(config.robot).ackermann().min_turning_radius(),
               node.random("planner")),
      transforms_(node.transforms()),
      scans_("map", kPatience, 20),
      plan_publisher_(node.advertise<nav_msgs::msg::Path>("plan", Qos::kStateLatched)),
      costmap_publisher_(
          node.advertise<nav_msgs::msg::OccupancyGrid>("global_costmap", Qos::kStateLatched)),
      status_publisher_(node.advertise<NavigationStatus>("navigation_status", Qos::kStateLatched)) {
  // A search that ends in finding nothing may take longer than a heartbeat.
  planner_.on_progress([&node] { node.keep_alive(); });
  node.subscribe<nav_msgs::msg::OccupancyGrid>("map", Qos::kStateLatched,
                                               [this](const nav_msgs::msg::OccupancyGrid& message) {
                                                 const auto map = conversions::from_msg(message);
                                                 if (map) planner_.map().set_map(map->value);
                                               });
  node.subscribe<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream, runtime::put_into(scans_),
                                              runtime::Attention::kPatient);
  node.subscribe<geometry_msgs::msg::PoseStamped>(
      "goal_pose", Qos::kEvent,
      [this](const geometry_msgs::msg::PoseStamped& message) { receive_goal(message); });
  node.subscribe<NavigationStatus>(
      "navigation_status", Qos::kStateLatched,
      [this](const NavigationStatus& message) { receive_driver(message); });
  node.subscribe<coop_msgs::msg::MissionStatus>(
      "mission_status", Qos::kStateLatched, [this](const coop_msgs::msg::MissionStatus& message) {
        planner_.map().set_spots(conversions::uncollected_eggs(message, config_.egg_radius));
      });
  node.subscribe<vision_msgs::msg::Detection3DArray>(
      "animals", Qos::kEvent,
      [this](const vision_msgs::msg::Detection3DArray& message) { receive_animals(message); },
      runtime::Attention::kPatient);
  node.every(kUpdatePeriod, [this] { update(); });
  publish_status();
}

void GlobalPlannerNode::receive_goal(const geometry_msgs::msg::PoseStamped& message) {
  if (message.header().frame_id().empty()) {
    take_back_goal(message);
    return;
  }
  const auto goal = conversions::from_msg(message);
  if (!goal || goal->frame_id != "map") {
    node_.log().warning("goal refused: {}",
                        goal ? "its frame is '" + goal->frame_id + "', not map" : goal.error());
    return;
  }
  // A goal told by hand may carry no stamp; it is told once and named by its arrival.
  const Time stamp = goal->stamp == Time{} ? node_.now() : goal->stamp;
  if (stamp != goal_stamp_) {
    node_.log().info("goal {}: ({:.2f}, {:.2f}, {:.2f})", to_nanoseconds(stamp), goal->value.x,
                     goal->value.y, goal->value.yaw);
  }
  goal_stamp_ = stamp;
  planner_.set_goal({std::to_string(to_nanoseconds(stamp)), goal->value}, node_.now());
}

void GlobalPlannerNode::take_back_goal(const geometry_msgs::msg::PoseStamped& message) {
  const auto stamp = conversions::from_msg(message.header().stamp());
  if (!stamp) {
    node_.log().warning("goal not taken back: {}", stamp.error());
    return;
  }
  const bool any = *stamp == Time{};
  if (!planner_.cancel(any ? "" : std::to_string(to_nanoseconds(*stamp)))) return;
  if (!any) goal_stamp_ = *stamp;
  node_.log().info("goal {} taken back", to_nanoseconds(goal_stamp_));
}

void GlobalPlannerNode::receive_animals(const vision_msgs::msg::Detection3DArray& message) {
  const auto animals = conversions::from_msg(message);
  if (!animals || animals->frame_id != "map") {
    node_.log().warning(
        "animals refused: {}",
        animals ? "their frame is '" + animals->frame_id + "', not map" : animals.error());
    return;
  }
  if (!planner_.map().animals().see(animals->value, animals->stamp)) {
    node_.log().warning("animals refused: {} of them", animals->value.size());
  }
}

void GlobalPlannerNode::receive_driver(const NavigationStatus& message) {
  if (message.source() != "dwa") return;
  DriverReport report;
  report.goal_id = message.goal_id();
  report.arrived = message.state() == Constants::ARRIVED;
  report.failed = message.state() == Constants::FAILED;
  report.wants_new_plan =
      message.state() == Constants::DRIVING && message.reason() == Constants::STUCK;
  planner_.report(report);
}

void GlobalPlannerNode::integrate_scans() {
  scans_.process(transforms_, node_.now(), [this](const LaserScan& scan, const Pose3& base_in_map) {
    const auto pose = scan_pose(transforms_, "map", scan, base_in_map);
    if (pose) planner_.map().integrate(scan, *pose);
  });
}

void GlobalPlannerNode::update() {
  integrate_scans();
  const auto found = newest_pose(transforms_, "map", "base_link", node_.now(), kPoseAge);
  const auto robot = found ? std::optional(found->pose) : std::nullopt;
  const GlobalPlanner::Changes changes = planner_.update(robot, node_.now());
  if (changes.plan) {
    node_.log().debug("plan of {} poses: {}", planner_.plan().size(), changes.why);
    publish_plan();
  }
  if (changes.status) publish_status();
  costmap_waits_ = costmap_waits_ || changes.costmap;
  if (costmap_waits_ && node_.now() - costmap_published_ >= kCostmapPeriod) publish_costmap();
  if (!planner_.map().has_map()) {
    node_.set_degraded("no map");
  } else if (!robot) {
    node_.set_degraded("no pose of the robot in map");
  } else {
    node_.set_ready();
  }
}

void GlobalPlannerNode::publish_plan() {
  plan_publisher_.publish(conversions::to_path_msg({goal_stamp_, "map", planner_.plan()}));
}

void GlobalPlannerNode::publish_status() {
  const PlannerStatus& status = planner_.status();
  NavigationStatus message;
  message.header(conversions::to_header(node_.now(), "map"));
  message.source("global_planner");
  message.goal_id(status.goal_id);
  message.state(to_state(status.state));
  message.reason(status.state == PlannerState::kCancelled ? Constants::CANCELLED
                                                          : to_reason(status.reason));
  message.detail(status.detail);
  message.distance_remaining(status.path_length);
  message.path_cost(status.path_cost);
  message.goal(conversions::to_msg(to_pose3(status.goal_in_map)));
  message.has_alternative_goal(status.alternative.has_value());
  if (status.alternative) {
    message.alternative_goal(conversions::to_msg(to_pose3(*status.alternative)));
  }
  status_publisher_.publish(message);
}

void GlobalPlannerNode::publish_costmap() {
  costmap_published_ = node_.now();
  costmap_waits_ = false;
  costmap_publisher_.publish(conversions::to_msg(
      Stamped<OccupancyGrid>{node_.now(), "map", to_occupancy(planner_.map().costmap().costs())}));
}

}  // namespace coop::global_planner
