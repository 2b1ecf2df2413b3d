#include "referee/node/referee_node.hpp"

#include <coop_msgs/msg/World.h>
#include <geometry_msgs/msg/PoseStamped.h>

#include "conversions/geometry.hpp"
#include "conversions/time.hpp"
#include "conversions/world.hpp"
#include "core/config/error.hpp"
#include "core/csv.hpp"

namespace coop::referee {

using coop_msgs::msg::GroundTruth;
using coop_msgs::msg::MissionStatus;
using coop_msgs::msg::NavigationStatus;
using runtime::Qos;
namespace EggConstants = coop_msgs::msg::EggStatus_Constants;
namespace MissionConstants = coop_msgs::msg::MissionStatus_Constants;
namespace NavigationConstants = coop_msgs::msg::NavigationStatus_Constants;

namespace {

constexpr auto kStepPeriod = std::chrono::milliseconds(100);
constexpr auto kPatience = std::chrono::seconds(1);

std::optional<Eigen::AlignedBox2d> scraper_of(const robot::RobotModel& robot) {
  if (!robot.has_link(robot::kScraperLink)) return std::nullopt;
  return robot.scraper();
}

/// Where a target has to be when the robot has arrived.
Eigen::Vector2d working_point_of(const robot::RobotModel& robot) {
  if (const auto scraper = scraper_of(robot)) return scraper->center();
  return robot.mount(robot::kWorkingPoint).translation().head<2>();
}

MissionEgg::Phase to_phase(std::uint8_t state) {
  switch (state) {
    case EggConstants::SEEN:
    case EggConstants::QUEUED:
      return MissionEgg::Phase::kWaiting;
    case EggConstants::APPROACHING:
      return MissionEgg::Phase::kApproaching;
    case EggConstants::PICKING:
      return MissionEgg::Phase::kPicking;
    default:
      return MissionEgg::Phase::kOver;
  }
}

NavigationView::State to_state(std::uint8_t state) {
  if (state == NavigationConstants::ARRIVED) return NavigationView::State::kArrived;
  if (state == NavigationConstants::FAILED) return NavigationView::State::kFailed;
  return NavigationView::State::kUnderWay;
}

}  // namespace

void RefereeNodeConfig::describe(config::Fields& fields) {
  fields.text("robot", robot, {.help = "URDF of the robot: the arm's working point"});
  fields.text("file", file, {.help = "table of the attempts, in the run's folder"});
  fields.text("legs_file", legs_file, {.help = "table of the drives between goals, there as well"});
  fields.text("heaps_file", heaps_file,
              {.help = "table of the heaps of a robot that cleans, there as well"});
  fields.number(
      "goal_radius", goal_radius,
      {.unit = "m", .help = "a goal of a drive is reached within", .min = 0.01, .max = 10});
  fields.number("time_limit", time_limit,
                {.unit = "s",
                 .help = "of the mission, by its clock, then the run is over; 0: none",
                 .min = 0});
  referee.describe(fields);
}

RefereeNode::Table::Table(const std::filesystem::path& file,
                          const std::vector<std::string>& columns)
    : path(file), out(file, std::ios::trunc) {
  out << csv_line(columns) << std::flush;
  if (!out) throw config::Error("cannot write " + path.string());
}

void RefereeNode::Table::add(const std::vector<std::string>& row) {
  ++rows;
  out << csv_line(row) << std::flush;
}

void RefereeNode::check(const Config& config) {
  (void)working_point_of(robot::RobotModel::load(config.robot));
}

RefereeNode::RefereeNode(runtime::Node& node, const Config& config)
    : RefereeNode(node, config, robot::RobotModel::load(config.robot)) {}

RefereeNode::RefereeNode(runtime::Node& node, const Config& config, const robot::RobotModel& robot)
    : node_(node),
      config_(config),
      referee_(config.referee, working_point_of(robot)),
      legs_(config.goal_radius),
      transforms_(node.transforms()),
      moments_("map", kPatience, 200),
      attempts_(node.options().run_dir / config.file, attempt_columns()),
      leg_table_(node.options().run_dir / config.legs_file, leg_columns()) {
  if (const auto scraper = scraper_of(robot)) {
    cleaning_.emplace(*scraper);
    heap_table_.emplace(node.options().run_dir / config.heaps_file, heap_columns());
  }
  subscribe();
  node.every(kStepPeriod, [this] { step(); });
  node.on_stop([this] {
    end();
    write_finished();
  });
}

void RefereeNode::end() {
  if (!referee_.has_ended()) write_heaps();
  referee_.end();
  legs_.end();
}

void RefereeNode::subscribe() {
  node_.subscribe<coop_msgs::msg::World>("world", Qos::kStateLatched,
                                         [this](const coop_msgs::msg::World& message) {
                                           const auto world = conversions::from_msg(message);
                                           if (!world) return;
                                           referee_.begin(*world);
                                           legs_.begin(world->robot_start);
                                           if (cleaning_) cleaning_->begin(*world);
                                         });
  // Every sample counts, but none needs an answer of its own.
  node_.subscribe<GroundTruth>(
      "ground_truth", Qos::kSensorStream, [this](const GroundTruth& message) { receive(message); },
      runtime::Attention::kPatient);
  node_.subscribe<geometry_msgs::msg::PoseStamped>(
      "goal_pose", Qos::kEvent, [this](const geometry_msgs::msg::PoseStamped& message) {
        const auto goal = conversions::from_msg(message);
        // A goal without a frame is one taken back.
        if (!goal || goal->frame_id.empty()) return;
        const std::string id = std::to_string(to_nanoseconds(goal->stamp));
        referee_.hear_goal(id);
        legs_.hear_goal(id, goal->value.position());
      });
  node_.subscribe<MissionStatus>("mission_status", Qos::kStateLatched,
                                 [this](const MissionStatus& message) { receive(message); });
  node_.subscribe<NavigationStatus>("navigation_status", Qos::kStateLatched,
                                    [this](const NavigationStatus& message) { receive(message); });
}

void RefereeNode::receive(const GroundTruth& message) {
  const auto truth = conversions::from_msg(message);
  if (!truth) return;
  referee_.see(*truth);
  legs_.see(*truth);
  if (cleaning_) cleaning_->see(*truth);
  moments_.push({truth->stamp, truth->robot_in_world}, "base_link", truth->stamp);
}

void RefereeNode::receive(const NavigationStatus& message) {
  NavigationView view;
  view.source = message.source() == "dwa" ? NavigationView::Source::kDriver
                                          : NavigationView::Source::kPlanner;
  view.state = to_state(message.state());
  view.goal_id = message.goal_id();
  referee_.hear(view);
}

void RefereeNode::receive(const MissionStatus& message) {
  if (message.state() != MissionConstants::IDLE && mission_begun_ == Time{}) {
    mission_begun_ = node_.now();
    if (cleaning_) cleaning_->begin_mission(mission_begun_);
  }
  MissionView view;
  view.ended =
      message.state() == MissionConstants::DONE || message.state() == MissionConstants::FAILED;
  if (view.ended && !referee_.has_ended()) write_heaps();
  // Heaps are judged by where the blade was, not attempt by attempt.
  for (const auto& egg : message.eggs()) {
    if (cleaning_) break;
    view.eggs.push_back({.id = egg.egg_id(),
                         .phase = to_phase(egg.state()),
                         .tries = egg.attempts(),
                         .reason = egg.reason(),
                         .egg_in_map = {egg.position().x(), egg.position().y()}});
  }
  referee_.hear(view);
}

void RefereeNode::step() {
  moments_.process(
      transforms_, node_.now(), [this](const Moment& moment, const Pose3& believed_in_map) {
        referee_.locate(moment.stamp, moment.robot_in_world, to_pose2(believed_in_map));
      });
  const bool time_is_up = config_.time_limit > 0.0 && mission_begun_ != Time{} &&
                          node_.now() - mission_begun_ > seconds(config_.time_limit);
  if (time_is_up) end();
  if (referee_.has_ended()) legs_.end();
  write_finished();
  if (referee_.has_ended()) node_.finish(time_is_up ? "time is up" : "the mission is over");
}

void RefereeNode::write_heaps() {
  if (!cleaning_) return;
  for (const CleanedHeap& heap : cleaning_->heaps()) {
    heap_table_->add(
        to_row(heap, node_.options().seed, heap_table_->rows + 1, cleaning_->mission_time()));
  }
}

void RefereeNode::write_finished() {
  const std::uint64_t seed = node_.options().seed;
  for (const Attempt& attempt : referee_.take_finished()) {
    attempts_.add(to_row(attempt, seed, attempts_.rows + 1));
    node_.log().info("attempt {}: egg '{}' {} {}", attempts_.rows, attempt.egg,
                     attempt.in_range ? "in range" : "missed:", to_string(attempt.cause));
  }
  for (const Leg& leg : legs_.take_finished()) {
    leg_table_.add(to_row(leg, seed, leg_table_.rows + 1));
  }
  for (const Table* table : {&attempts_, &leg_table_}) {
    if (!table->out) node_.set_degraded("cannot write " + table->path.string());
  }
}

}  // namespace coop::referee
