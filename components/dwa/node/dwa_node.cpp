#include "dwa/node/dwa_node.hpp"

#include "conversions/detections.hpp"
#include "conversions/geometry.hpp"
#include "conversions/mission.hpp"
#include "conversions/navigation.hpp"
#include "conversions/time.hpp"
#include "coop_msgs/msg/EmergencyStop.h"
#include "coop_msgs/msg/MissionStatus.h"
#include "runtime/scan_subscription.hpp"

namespace coop::dwa {

using coop_msgs::msg::NavigationStatus;
using runtime::Qos;
namespace Constants = coop_msgs::msg::NavigationStatus_Constants;

namespace {

constexpr auto kPatience = std::chrono::milliseconds(500);
constexpr auto kStatusPeriod = std::chrono::milliseconds(500);

std::uint8_t to_state(DriveState state) {
  switch (state) {
    case DriveState::kIdle:
      return Constants::IDLE;
    case DriveState::kDriving:
      return Constants::DRIVING;
    case DriveState::kArrived:
      return Constants::ARRIVED;
    case DriveState::kFailed:
      return Constants::FAILED;
  }
  return Constants::IDLE;
}

std::uint8_t to_reason(DriveReason reason) {
  switch (reason) {
    case DriveReason::kNone:
      return Constants::NONE;
    case DriveReason::kNoPose:
      return Constants::NO_POSE;
    case DriveReason::kSensorStale:
      return Constants::SENSOR_STALE;
    case DriveReason::kEmergencyStop:
      return Constants::EMERGENCY_STOP;
    case DriveReason::kStuck:
    case DriveReason::kMissedGoal:
      return Constants::STUCK;
  }
  return Constants::NONE;
}

bool is_input_missing(DriveReason reason) {
  return reason == DriveReason::kNoPose || reason == DriveReason::kSensorStale;
}

}  // namespace

void DwaNodeConfig::describe(config::Fields& fields) {
  fields.text("robot", robot, {.help = "URDF of the robot: footprint, turning circle"});
  fields.number("egg_radius", egg_radius,
                {.unit = "m", .help = "kept clear around an egg on the floor", .min = 0, .max = 1});
  fields.number("picture_period", picture_period,
                {.unit = "s", .help = "between messages for people", .min = 0.05, .max = 10});
  dwa.describe(fields);
}

DwaNode::DwaNode(runtime::Node& node, const Config& config)
    : DwaNode(node, config, robot::RobotModel::load(config.robot)) {}

DwaNode::DwaNode(runtime::Node& node, const Config& config, const robot::RobotModel& robot)
    : node_(node),
      config_(config),
      base_(robot.ackermann()),
      dwa_(config.dwa, robot.footprint(), robot.ackermann(), robot.ackermann().max_steering_rate),
      transforms_(node.transforms()),
      scans_("odom", kPatience, 10),
      command_publisher_(
          node.advertise<geometry_msgs::msg::TwistStamped>("cmd_vel", Qos::kCommand)),
      status_publisher_(node.advertise<NavigationStatus>("navigation_status", Qos::kStateLatched)),
      plan_publisher_(node.advertise<nav_msgs::msg::Path>("local_plan", Qos::kSensorStream)),
      costmap_publisher_(
          node.advertise<nav_msgs::msg::OccupancyGrid>("local_costmap", Qos::kSensorStream)),
      candidates_publisher_(
          node.advertise<coop_msgs::msg::DwaCandidates>("dwa_candidates", Qos::kSensorStream)) {
  subscribe();
  node.every(seconds(config.dwa.control_period), [this] { step(); });
}

void DwaNode::subscribe() {
  node_.subscribe<nav_msgs::msg::Odometry>(
      "odom", Qos::kSensorStream,
      [this](const nav_msgs::msg::Odometry& message) {
        if (const auto odometry = conversions::from_msg(message)) {
          inputs_.odometry = odometry->odometry;
        }
      },
      runtime::Attention::kPatient);
  node_.subscribe<sensor_msgs::msg::LaserScan>(
      "scan", Qos::kSensorStream, runtime::put_into(scans_), runtime::Attention::kPatient);
  node_.subscribe<nav_msgs::msg::OccupancyGrid>(
      "map", Qos::kStateLatched, [this](const nav_msgs::msg::OccupancyGrid& message) {
        if (const auto map = conversions::from_msg(message)) {
          dwa_.local_map().set_static_map(map->value);
        }
      });
  node_.subscribe<nav_msgs::msg::Path>(
      "plan", Qos::kStateLatched,
      [this](const nav_msgs::msg::Path& message) { receive_plan(message); });
  node_.subscribe<coop_msgs::msg::EmergencyStop>(
      "emergency_stop", Qos::kStateLatched, [this](const coop_msgs::msg::EmergencyStop& message) {
        emergency_stops_.set(message.source(), message.engaged(), message.reason());
      });
  node_.subscribe<coop_msgs::msg::MissionStatus>(
      "mission_status", Qos::kStateLatched, [this](const coop_msgs::msg::MissionStatus& message) {
        dwa_.local_map().set_spots(conversions::uncollected_eggs(message, config_.egg_radius));
      });
  if (!config_.dwa.animals.use) return;
  node_.subscribe<vision_msgs::msg::Detection3DArray>(
      "animals", Qos::kEvent,
      [this](const vision_msgs::msg::Detection3DArray& message) { receive_animals(message); },
      runtime::Attention::kPatient);
}

void DwaNode::receive_animals(const vision_msgs::msg::Detection3DArray& message) {
  const auto animals = conversions::from_msg(message);
  if (!animals || animals->frame_id != "map") {
    node_.log().warning("animals refused: {}",
                        animals ? "their frame is not map" : animals.error());
    return;
  }
  if (!dwa_.animals().see(animals->value, animals->stamp)) {
    node_.log().warning("animals refused: {} of them", animals->value.size());
  }
}

void DwaNode::receive_plan(const nav_msgs::msg::Path& message) {
  auto path = conversions::from_msg(message);
  if (!path || (path->frame_id != "map" && !path->value.empty())) {
    node_.log().warning("plan refused: {}", path ? "its frame is not map" : path.error());
    return;
  }
  dwa_.set_plan(std::to_string(to_nanoseconds(path->stamp)), std::move(path->value));
}

void DwaNode::integrate_scans() {
  scans_.process(transforms_, node_.now(),
                 [this](const LaserScan& scan, const Pose3& base_in_odom) {
                   const auto pose = scan_pose(transforms_, "odom", scan, base_in_odom);
                   if (!pose) return;
                   dwa_.local_map().integrate(scan, *pose);
                   inputs_.scan_stamp = scan.stamp + scan.sweep_duration();
                 });
}

void DwaNode::step() {
  const Time now = node_.now();
  integrate_scans();
  inputs_.odom_in_map = newest_pose(transforms_, "map", "odom", now);
  inputs_.emergency_stop = emergency_stops_.engaged();
  const DwaOutput output = dwa_.update(inputs_, now);
  command_publisher_.publish(
      conversions::to_msg(Stamped<Twist2>{now, "base_link", output.command}));
  const bool changed =
      !last_output_ || last_output_->state != output.state || last_output_->reason != output.reason;
  if (changed || now - last_status_ >= kStatusPeriod) publish_status(output);
  last_output_ = output;
  if (is_input_missing(output.reason)) {
    node_.set_degraded(output.detail);
  } else {
    node_.set_ready();
  }
  if (now - last_picture_ >= seconds(config_.picture_period)) publish_pictures();
}

void DwaNode::publish_status(const DwaOutput& output) {
  last_status_ = node_.now();
  NavigationStatus message;
  message.header(conversions::to_header(node_.now(), "map"));
  message.source("dwa");
  message.goal_id(dwa_.goal_id());
  message.state(to_state(output.state));
  message.reason(to_reason(output.reason));
  message.detail(output.detail);
  message.distance_remaining(output.distance_remaining);
  status_publisher_.publish(message);
}

void DwaNode::publish_pictures() {
  last_picture_ = node_.now();
  if (plan_publisher_.has_subscribers()) {
    plan_publisher_.publish(conversions::to_path_msg({node_.now(), "odom", dwa_.chosen()}));
  }
  if (costmap_publisher_.has_subscribers()) {
    costmap_publisher_.publish(conversions::to_msg(
        Stamped<OccupancyGrid>{node_.now(), "odom", to_occupancy(dwa_.costmap().costs())}));
  }
  if (candidates_publisher_.has_subscribers()) publish_candidates();
}

void DwaNode::publish_candidates() {
  coop_msgs::msg::DwaCandidates message;
  message.header(conversions::to_header(node_.now(), "odom"));
  message.chosen(-1);
  double best = -std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : dwa_.candidates()) {
    coop_msgs::msg::DwaCandidate item;
    item.v(candidate.command.speed);
    item.omega(vehicle::twist_of(base_, candidate.command.speed, candidate.command.steering).omega);
    item.score(candidate.score);
    item.admissible(candidate.admissible);
    for (const Pose2& pose : candidate.trajectory) {
      geometry_msgs::msg::Point32 point;
      point.x(static_cast<float>(pose.x));
      point.y(static_cast<float>(pose.y));
      item.points().push_back(point);
    }
    if (candidate.admissible && candidate.score > best) {
      best = candidate.score;
      message.chosen(static_cast<std::int32_t>(message.candidates().size()));
    }
    message.candidates().push_back(std::move(item));
  }
  candidates_publisher_.publish(message);
}

}  // namespace coop::dwa
