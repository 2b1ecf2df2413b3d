#include "sequencer/node/sequencer_node.hpp"

#include <charconv>

#include "conversions/detections.hpp"
#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "conversions/time.hpp"
#include "coop_msgs/msg/PickResult.h"
#include "core/config/error.hpp"
#include "core/robot/robot_model.hpp"
#include "nav_msgs/msg/OccupancyGrid.h"
#include "sequencer/node/mission_messages.hpp"

namespace coop::sequencer {

using coop_msgs::msg::NavigationStatus;
using coop_msgs::msg::PickResult;
using runtime::Qos;
namespace MissionConstants = coop_msgs::msg::Mission_Constants;

namespace {

constexpr auto kStepPeriod = std::chrono::milliseconds(100);
constexpr auto kStatusPeriod = std::chrono::seconds(1);
constexpr auto kPatience = std::chrono::seconds(2);
/// Answers to so many goals are kept; only the latest goal's counts.
constexpr std::size_t kGoalsKept = 20;
/// A pose older than this is no pose.
constexpr auto kPoseAge = std::chrono::seconds(1);

/// A robot with a scraper cleans, one without collects.
std::optional<Eigen::AlignedBox2d> scraper_of(const robot::RobotModel& robot) {
  if (!robot.has_link(robot::kScraperLink)) return std::nullopt;
  return robot.scraper();
}

}  // namespace

void SequencerNode::check(const Config& config) {
  const bool cleans = scraper_of(robot::RobotModel::load(config.robot)).has_value();
  const std::string other = cleans ? "collect" : "clean";
  if (config.autostart != other) return;
  throw config::Error("autostart: " + other + ": " + config.robot + " has " +
                      (cleans ? "a " : "no ") + std::string(robot::kScraperLink));
}

SequencerNode::SequencerNode(runtime::Node& node, const Config& config)
    : SequencerNode(node, config, robot::RobotModel::load(config.robot)) {}

SequencerNode::SequencerNode(runtime::Node& node, const Config& config,
                             const robot::RobotModel& robot)
    : node_(node),
      config_(config),
      cleans_(scraper_of(robot).has_value()),
      sequencer_(config, Footprint(robot.footprint()), node.random("ant_colony"),
                 scraper_of(robot)),
      journal_(node.options().run_dir / (node.name() + ".journal")),
      transforms_(node.transforms()),
      waiting_("map", kPatience, 50),
      goal_publisher_(node.advertise<geometry_msgs::msg::PoseStamped>("goal_pose", Qos::kEvent)),
      pick_publisher_(node.advertise<coop_msgs::msg::Pick>("pick", Qos::kEvent)),
      status_publisher_(
          node.advertise<coop_msgs::msg::MissionStatus>("mission_status", Qos::kStateLatched)) {
  if (const auto state = Journal::read(node.options().run_dir / (node.name() + ".journal"))) {
    sequencer_.restore(*state, node.now());
    node.log().info("mission {} goes on: {} {}", state->mission_id, to_string(state->phase),
                    state->detail);
  }
  node.subscribe<nav_msgs::msg::OccupancyGrid>(
      "global_costmap", Qos::kStateLatched, [this](const nav_msgs::msg::OccupancyGrid& message) {
        if (const auto grid = conversions::from_msg(message)) sequencer_.set_costmap(grid->value);
      });
  node.subscribe<coop_msgs::msg::Mission>(
      "mission", Qos::kStateLatched,
      [this](const coop_msgs::msg::Mission& message) { receive_mission(message); });
  using Detections = vision_msgs::msg::Detection3DArray;
  const auto see = [this](const Detections& message) { receive_eggs(message); };
  if (cleans_) node.subscribe<Detections>("manure", Qos::kEvent, see);
  if (!cleans_) node.subscribe<Detections>("eggs", Qos::kEvent, see);
  node.subscribe<sensor_msgs::msg::CameraInfo>(
      "camera/camera_info", Qos::kSensorStream,
      [this](const sensor_msgs::msg::CameraInfo& message) {
        if (auto camera = conversions::from_msg(message)) camera_ = std::move(*camera);
      },
      runtime::Attention::kPatient);
  node.subscribe<NavigationStatus>(
      "navigation_status", Qos::kStateLatched,
      [this](const NavigationStatus& message) { receive_navigation(message); });
  node.subscribe<PickResult>("pick_result", Qos::kEvent,
                             [this](const PickResult& message) { pick_ = to_report(message); });
  node.every(kStepPeriod, [this] { step(); });
}

void SequencerNode::receive_mission(const coop_msgs::msg::Mission& message) {
  Mission& mission = sequencer_.mission();
  switch (message.command()) {
    case MissionConstants::PAUSE:
      mission.pause();
      return;
    case MissionConstants::RESUME:
      mission.resume();
      return;
    case MissionConstants::ABORT:
      mission.abort("aborted by " +
                    (message.mission_id().empty() ? "order" : message.mission_id()));
      return;
    default:
      break;
  }
  // The order is latched: after a restart it arrives again, and the journal knows that mission
  // already.
  if (message.mission_id() == mission.state().mission_id) return;
  if (!can_do(message.kind())) {
    node_.log().error("mission {}: kind {} is not one for this robot", message.mission_id(),
                      message.kind());
    return;
  }
  std::vector<Waypoint> waypoints;
  for (const auto& pose_message : message.waypoints()) {
    const auto pose = conversions::pose3_from_msg(pose_message);
    if (!pose) {
      node_.log().error("mission {} refused: {}", message.mission_id(), pose.error());
      return;
    }
    waypoints.push_back({"waypoint " + std::to_string(waypoints.size() + 1), to_pose2(*pose)});
  }
  if (waypoints.empty()) waypoints = config_.waypoint_list();
  mission.start(static_cast<MissionKind>(message.kind()), message.mission_id(),
                std::move(waypoints));
}

bool SequencerNode::can_do(std::uint8_t kind) const {
  if (kind == MissionConstants::SURVEY) return true;
  return kind == (cleans_ ? MissionConstants::CLEAN : MissionConstants::COLLECT);
}

void SequencerNode::receive_eggs(const vision_msgs::msg::Detection3DArray& message) {
  auto detections = conversions::from_msg(message);
  if (!detections) {
    if (node_.log().is_due("bad eggs", std::chrono::seconds(5))) {
      node_.log().warning("detections ignored: {}", detections.error());
    }
    return;
  }
  const std::string frame = detections->frame_id;
  const Time stamp = detections->stamp;
  waiting_.push(std::move(*detections), frame, stamp);
}

void SequencerNode::receive_navigation(const NavigationStatus& message) {
  const auto report = to_report(message);
  if (!report) return;
  std::int64_t stamp = 0;
  const char* const end = report->goal_id.data() + report->goal_id.size();
  if (std::from_chars(report->goal_id.data(), end, stamp).ptr != end) return;  // no goal of ours
  navigation_[stamp] = *report;
  while (navigation_.size() > kGoalsKept) navigation_.erase(navigation_.begin());
}

void SequencerNode::look_at_sightings() {
  waiting_.process(transforms_, node_.now(),
                   [this](const Stamped<std::vector<Detection>>& seen, const Pose3& camera) {
                     Picture picture{seen.stamp,
                                     to_sightings(seen.value, cleans_ ? "manure" : "egg", camera),
                                     {}};
                     if (camera_ && camera_->frame_id == seen.frame_id) {
                       picture.view = CameraView{camera, camera_->value};
                     }
                     sequencer_.see(picture);
                   });
}

void SequencerNode::autostart() {
  const Mission& mission = sequencer_.mission();
  if (config_.autostart == "none" || !mission.state().mission_id.empty()) return;
  const auto kind = config_.autostart == "survey"  ? MissionKind::kSurvey
                    : config_.autostart == "clean" ? MissionKind::kClean
                                                   : MissionKind::kCollect;
  sequencer_.mission().start(kind, config_.autostart + "-1", config_.waypoint_list());
}

void SequencerNode::step() {
  look_at_sightings();
  if (unwritten_) {
    const MissionActions held = *unwritten_;
    unwritten_.reset();
    carry_out(held);
    if (unwritten_) return;
  }
  MissionSnapshot snapshot;
  const auto robot = newest_pose(transforms_, "map", "base_link", node_.now(), kPoseAge);
  if (robot) snapshot.robot_in_map = robot->pose;
  if (snapshot.robot_in_map && sequencer_.has_costmap()) autostart();
  if (!navigation_.empty()) snapshot.navigation = navigation_.rbegin()->second;
  snapshot.pick = pick_;
  if (!snapshot.robot_in_map) {
    node_.set_degraded("no pose of the robot in map");
  } else {
    node_.set_ready();
  }
  carry_out(sequencer_.step(snapshot, node_.now()));
}

void SequencerNode::carry_out(const MissionActions& actions) {
  const MissionState& state = sequencer_.mission().state();
  if (actions.state_changed) {
    if (!journal_.append(state)) {
      node_.set_degraded("the journal cannot be written: nothing is ordered until it can");
      unwritten_ = actions;
      return;
    }
    const std::string line = std::string(to_string(state.phase)) + ": " + state.detail;
    if (line != logged_) node_.log().info("{}", line);
    logged_ = line;
  }
  if (actions.goal) {
    geometry_msgs::msg::PoseStamped goal = conversions::to_msg(Stamped<Pose2>{
        Time(Duration(std::stoll(actions.goal->goal_id))), "map", actions.goal->pose_in_map});
    goal_publisher_.publish(goal);
  }
  if (actions.take_back) {  // a goal without a frame
    goal_publisher_.publish(conversions::to_msg(
        Stamped<Pose2>{Time(Duration(std::stoll(*actions.take_back))), "", {}}));
  }
  if (actions.pick) {
    coop_msgs::msg::Pick pick;
    pick.header(conversions::to_header(node_.now(), "map"));
    pick.pick_id(actions.pick->pick_id);
    pick.egg_id(actions.pick->egg_id);
    pick.position().x(actions.pick->egg_in_map.x());
    pick.position().y(actions.pick->egg_in_map.y());
    pick_publisher_.publish(pick);
  }
  if (actions.state_changed || node_.now() - last_status_ >= kStatusPeriod) publish_status();
}

void SequencerNode::publish_status() {
  last_status_ = node_.now();
  status_publisher_.publish(to_msg(sequencer_.mission().state(), sequencer_.tracks(), node_.now()));
}

}  // namespace coop::sequencer
