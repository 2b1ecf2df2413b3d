#include "experiments/navigation/closed_loop.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/vehicle/drive_controller.hpp"
#include "core/world/ray_caster.hpp"

namespace coop::test {
namespace {

constexpr double kTick = 0.01;           // s
constexpr int kPlantTicks = 2;           // 50 Hz
constexpr int kControlTicks = 5;         // 20 Hz
constexpr int kScanTicks = 10;           // 10 Hz
constexpr int kPlannerTicks = 10;        // 10 Hz
constexpr double kSteeringRate = 0.8;    // rad/s
constexpr double kEggRadius = 0.03;      // m
constexpr double kEggSpotRadius = 0.06;  // m kept clear by the planners
constexpr std::size_t kBeams = 360;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

vehicle::AckermannGeometry geometry_of(const ExperimentRobot& robot) {
  vehicle::AckermannGeometry geometry;
  geometry.wheelbase = robot.wheelbase;
  geometry.track = robot.track;
  geometry.max_steering_angle = robot.max_steering;
  geometry.max_steering_rate = kSteeringRate;
  return geometry;
}

/// The house with the obstacles that the map does not know.
OccupancyGrid with_obstacles(OccupancyGrid house, const std::vector<Eigen::Vector3d>& discs) {
  for (std::size_t i = 0; i < house.cells.size(); ++i) {
    const Eigen::Vector2d center = house.geometry.center_of(house.geometry.cell_at(i));
    for (const Eigen::Vector3d& disc : discs) {
      if ((center - disc.head<2>()).norm() <= disc.z()) house.cells[i] = kOccupied;
    }
  }
  return house;
}

class Loop {
 public:
  Loop(const ClosedLoopConfig& config, const OccupancyGrid& house, const EggTask& task,
       std::uint64_t seed)
      : config_(config),
        task_(task),
        geometry_(geometry_of(robot_)),
        tasks_(house, robot_),
        true_house_(with_obstacles(house, config.new_obstacles)),
        truth_(true_house_, robot_),
        rays_(true_house_),
        random_(seed, "closed_loop"),
        drive_({}, geometry_),
        planner_(config.planner, robot_.footprint, geometry_.min_turning_radius(),
                 RandomStream(seed, "planner")),
        dwa_(config.dwa, robot_.footprint, geometry_, kSteeringRate),
        robot_now_(task.start) {
    planner_.map().set_map(house);
    dwa_.local_map().set_static_map(house);
    if (config.keep_clear_of_egg) {
      planner_.map().set_spots({{task.egg, kEggSpotRadius}});
      dwa_.local_map().set_spots({{task.egg, kEggSpotRadius}});
    }
  }

  RunResult run() {
    const int ticks = static_cast<int>(config_.time_limit / kTick);
    for (int tick = 0; tick < ticks && !done_; ++tick) {
      now_ = time_from_seconds(1000.0 + tick * kTick);
      if (tick % kPlantTicks == 0) move();
      if (tick % kScanTicks == 0) sense();
      if (tick % kPlannerTicks == 0) plan();
      if (tick % kControlTicks == 0) control();
      result_.time = tick * kTick;
    }
    if (!done_) result_.failure = "time ran out: " + last_detail_;
    result_.egg_in_base = robot_now_.inverse() * task_.egg;
    const Eigen::Vector2d error = result_.egg_in_base - kWorkingPoint;
    result_.success = result_.arrived && std::abs(error.x()) <= 0.10 && std::abs(error.y()) <= 0.12;
    if (result_.arrived && !result_.success) result_.failure = "the egg is out of reach";
    return result_;
  }

 private:
  void move() {
    const Duration step = seconds(kPlantTicks * kTick);
    const vehicle::DriveSetpoint& setpoint = drive_.step(now_, step);
    const Twist2 twist = vehicle::twist_of(geometry_, setpoint.speed, setpoint.steering);
    const double dt = to_seconds(step);
    robot_now_ = vehicle::advance_along_arc(robot_now_, twist.v * dt, twist.omega * dt);
    odometry_ = {now_, odom_in_world_.inverse() * robot_now_, twist};
    result_.driven += std::abs(twist.v) * dt;
    if (truth_.collides(robot_now_)) ++result_.collisions;
    const Eigen::Vector2d egg = robot_now_.inverse() * task_.egg;
    if (Footprint(robot_.footprint, kEggRadius).contains(egg)) result_.ran_over_egg = true;
    const int moving = twist.v > 0.01 ? 1 : (twist.v < -0.01 ? -1 : 0);
    if (moving != 0 && last_moving_ != 0 && moving != last_moving_) ++result_.direction_changes;
    if (moving != 0) last_moving_ = moving;
  }

  void sense() {
    const Pose2 wrong{random_.normal(0.0, config_.position_noise),
                      random_.normal(0.0, config_.position_noise),
                      random_.normal(0.0, config_.heading_noise)};
    // The error of localisation is one of the robot's pose in the map.
    odom_in_map_ = {now_, robot_now_ * wrong * odometry_.base_in_odom.inverse()};
    LaserScan scan;
    scan.stamp = now_;
    scan.frame_id = "laser_link";
    scan.angle_min = -std::numbers::pi_v<float>;
    scan.angle_increment = 2.0F * std::numbers::pi_v<float> / static_cast<float>(kBeams);
    scan.range_min = 0.1F;
    scan.range_max = 8.0F;
    const Pose2 laser = robot_now_ * Pose2{robot_.laser_x, 0.0, 0.0};
    for (std::size_t i = 0; i < kBeams; ++i) {
      const double angle = laser.yaw + scan.angle(i);
      const auto hit =
          rays_.cast(laser.position(), {std::cos(angle), std::sin(angle)}, scan.range_max);
      const double noise = random_.normal(0.0, config_.range_noise);
      scan.ranges.push_back(hit ? static_cast<float>(hit->range + noise)
                                : std::numeric_limits<float>::infinity());
    }
    scan_stamp_ = now_;
    const Pose2 mount{robot_.laser_x, 0.0, 0.0};
    const double before = cpu_seconds();
    dwa_.local_map().integrate(scan, {odometry_.base_in_odom, odometry_.base_in_odom, mount});
    const double between = cpu_seconds();
    planner_.map().integrate(scan, {believed(), believed(), mount});
    result_.dwa_cpu += between - before;
    result_.planner_cpu += cpu_seconds() - between;
    result_.moments.push_back(
        {to_seconds(now_) - 1000.0, robot_now_, odometry_.velocity, believed()});
  }

  [[nodiscard]] Pose2 believed() const { return odom_in_map_.pose * odometry_.base_in_odom; }

  void send_goal(const Pose2& goal) {
    planner_.set_goal({std::to_string(++goal_number_), goal}, now_);
    result_.goals_sent.push_back(goal);
    sent_at_ = now_;
  }

  void next_goal(const std::string& why) {
    const auto goal = tasks_.goal_for(believed(), task_.egg, result_.goals);
    if (!goal || result_.goals >= config_.max_goals) {
      done_ = true;
      result_.failure = why.empty() ? "no free approach pose" : why;
      return;
    }
    approach_yaw_ = goal->yaw;
    ++result_.goals;
    send_goal(*goal);
  }

  void refresh_goal() {
    if (config_.goal_refresh_period <= 0.0 ||
        to_seconds(now_ - sent_at_) < config_.goal_refresh_period) {
      return;
    }
    const Eigen::Vector2d egg = task_.egg + config_.goal_refresh_noise *
                                                Eigen::Vector2d(random_.normal(), random_.normal());
    const Eigen::Vector2d back(std::cos(approach_yaw_), std::sin(approach_yaw_));
    const Eigen::Vector2d at = egg - kWorkingPoint.x() * back;
    send_goal({at.x(), at.y(), approach_yaw_});
  }

  void plan() {
    using global_planner::PlannerState;
    if (result_.goals == 0) next_goal("");
    if (done_) return;
    refresh_goal();
    const double before = cpu_seconds();
    const auto changes = planner_.update(believed(), now_);
    result_.planner_cpu += cpu_seconds() - before;
    if (changes.plan && !planner_.plan().empty()) {
      ++result_.plans;
      result_.plans_made.push_back(planner_.plan());
      result_.log.push_back(std::to_string(to_seconds(now_) - 1000.0) + " plan: " + changes.why);
    }
    if (changes.plan) dwa_.set_plan(planner_.status().goal_id, planner_.plan());
    if (planner_.status().state == PlannerState::kFailed) next_goal(planner_.status().detail);
  }

  void control() {
    using dwa::DriveReason;
    using dwa::DriveState;
    const double before = cpu_seconds();
    const dwa::DwaOutput output = dwa_.update({odometry_, odom_in_map_, scan_stamp_, false}, now_);
    result_.dwa_cpu += cpu_seconds() - before;
    drive_.gate().accept(output.command, now_);
    if (output.detail != last_detail_ && !output.detail.empty()) {
      result_.log.push_back(std::to_string(to_seconds(now_) - 1000.0) + " dwa: " + output.detail);
    }
    last_detail_ = output.detail;
    const bool wants =
        output.state == DriveState::kDriving &&
        (output.reason == DriveReason::kStuck || output.reason == DriveReason::kMissedGoal);
    planner_.report({dwa_.goal_id(), output.state == DriveState::kArrived,
                     output.state == DriveState::kFailed, wants});
    if (output.state == DriveState::kArrived && dwa_.goal_id() == std::to_string(goal_number_)) {
      result_.arrived = true;
      done_ = true;
    }
    if (output.state == DriveState::kFailed && dwa_.goal_id() == std::to_string(goal_number_)) {
      next_goal(output.detail);
    }
  }

  ClosedLoopConfig config_;
  EggTask task_;
  ExperimentRobot robot_;
  vehicle::AckermannGeometry geometry_;
  TaskSource tasks_;
  OccupancyGrid true_house_;
  TaskSource truth_;
  world::RayCaster rays_;
  RandomStream random_;
  vehicle::DriveController drive_;
  global_planner::GlobalPlanner planner_;
  dwa::Dwa dwa_;
  Pose2 robot_now_;
  Pose2 odom_in_world_{3.0, -2.0, 0.7};  // anywhere: odom has no meaning of its own
  Odometry odometry_;
  StampedPose2 odom_in_map_;
  std::optional<Time> scan_stamp_;
  Time now_{};
  Time sent_at_{};
  double approach_yaw_ = 0.0;
  int goal_number_ = 0;
  int last_moving_ = 0;
  bool done_ = false;
  std::string last_detail_;
  RunResult result_;
};

}  // namespace

void ClosedLoopConfig::describe(config::Fields& fields) {
  fields.number("time_limit", time_limit, {.unit = "s", .help = "for one egg"});
  fields.integer("max_goals", max_goals, {.help = "approach poses tried for one egg"});
  fields.number("position_noise", position_noise, {.unit = "m", .help = "of the localisation"});
  fields.number("heading_noise", heading_noise, {.unit = "rad", .help = "of the localisation"});
  fields.number("range_noise", range_noise, {.unit = "m", .help = "of the laser"});
  fields.number("goal_refresh_period", goal_refresh_period, {.unit = "s", .help = "0: never"});
  fields.number("goal_refresh_noise", goal_refresh_noise, {.unit = "m", .help = "of the egg"});
  fields.flag("keep_clear_of_egg", keep_clear_of_egg, {.help = "the planners know of the egg"});
  fields.section("dwa", dwa);
  fields.section("planner", planner);
}

RunResult run_closed_loop(const ClosedLoopConfig& config, const OccupancyGrid& house,
                          const EggTask& task, std::uint64_t seed) {
  return Loop(config, house, task, seed).run();
}

}  // namespace coop::test
