#include "simulator/vehicle_dynamics.hpp"

#include <algorithm>
#include <cmath>

namespace coop::simulator {
namespace {

/// Below this a drive asked to stand does stand (a lag alone would creep for ever), m/s.
constexpr double kBreakaway = 0.01;

double lag(double value, double target, double dt, double time_constant) {
  if (time_constant <= 0.0) return target;
  return value + (target - value) * (1.0 - std::exp(-dt / time_constant));
}

double slipped(double rolled, double slip, double random, RandomStream& noise) {
  const double deviation = random * std::sqrt(std::abs(rolled));
  return rolled * (1.0 - slip) + deviation * noise.normal();
}

}  // namespace

void SlipConfig::describe(config::Fields& fields) {
  fields.number(
      "left", left,
      {.unit = "1", .help = "share of the rolled distance lost", .min = -0.5, .max = 0.9});
  fields.number(
      "right", right,
      {.unit = "1", .help = "share of the rolled distance lost", .min = -0.5, .max = 0.9});
  fields.number(
      "random", random,
      {.unit = "m/sqrt(m)", .help = "deviation of each wheel's travel", .min = 0, .max = 0.5});
  fields.number("yaw_share", yaw_share,
                {.unit = "1",
                 .help = "share of the wheels' difference in slip that turns the body",
                 .min = 0,
                 .max = 1});
}

void ActuatorErrorConfig::describe(config::Fields& fields) {
  fields.number("speed", speed,
                {.unit = "1", .help = "deviation of the speed's set point", .min = 0, .max = 0.5});
  fields.number(
      "steering", steering,
      {.unit = "rad", .help = "deviation of the steering's set point", .min = 0, .max = 0.3});
  fields.number("correlation_time", correlation_time,
                {.unit = "s", .help = "over which these errors wander", .min = 0.01, .max = 1000});
  fields.number("steering_offset", steering_offset,
                {.unit = "rad",
                 .help = "deviation over runs of the true minus the indicated angle",
                 .min = 0,
                 .max = 0.3});
}

void VehicleConfig::describe(config::Fields& fields) {
  fields.number("speed_time_constant", speed_time_constant,
                {.unit = "s", .help = "lag of the drive behind its set point", .min = 0, .max = 5});
  fields.number(
      "steering_time_constant", steering_time_constant,
      {.unit = "s", .help = "lag of the steering behind its set point", .min = 0, .max = 5});
  fields.number(
      "steering_offset", steering_offset,
      {.unit = "rad", .help = "true minus indicated steering angle", .min = -0.3, .max = 0.3});
  fields.section("slip", slip);
  fields.section("actuators", actuators);
}

VehicleDynamics::VehicleDynamics(const VehicleConfig& config,
                                 const vehicle::AckermannGeometry& base, const Pose2& start,
                                 std::uint64_t seed)
    : config_(config),
      base_(base),
      slip_noise_(seed, "simulator/slip"),
      actuator_noise_(seed, "simulator/actuators") {
  state_.robot_in_world = start;
  RandomStream adjustment(seed, "simulator/steering_offset");
  config_.steering_offset += adjustment.normal(0.0, config.actuators.steering_offset);
}

/// A step of both errors' Gauss-Markov processes, which keeps their deviations.
void VehicleDynamics::wander(double dt) {
  const ActuatorErrorConfig& errors = config_.actuators;
  const double kept = std::exp(-dt / errors.correlation_time);
  const double fresh = std::sqrt(1.0 - kept * kept);
  state_.speed_error =
      kept * state_.speed_error + fresh * actuator_noise_.normal(0.0, errors.speed);
  state_.steering_error =
      kept * state_.steering_error + fresh * actuator_noise_.normal(0.0, errors.steering);
}

VehicleMotion VehicleDynamics::roll(const vehicle::DriveSetpoint& setpoint, double dt) {
  wander(dt);
  state_.speed = lag(state_.speed, setpoint.speed * (1.0 + state_.speed_error), dt,
                     config_.speed_time_constant);
  if (setpoint.speed == 0.0 && std::abs(state_.speed) < kBreakaway) state_.speed = 0.0;
  state_.steering = std::clamp(lag(state_.steering, setpoint.steering + state_.steering_error, dt,
                                   config_.steering_time_constant),
                               -base_.max_steering_angle, base_.max_steering_angle);

  const vehicle::WheelSpeeds wheels = vehicle::wheel_speeds(base_, state_.speed, state_.steering);
  VehicleMotion motion;
  motion.rolled_left = wheels.rear_left * dt;
  motion.rolled_right = wheels.rear_right * dt;
  const SlipConfig& slip = config_.slip;
  const double left = slipped(motion.rolled_left, slip.left, slip.random, slip_noise_);
  const double right = slipped(motion.rolled_right, slip.right, slip.random, slip_noise_);
  const double lost_difference = (right - motion.rolled_right) - (left - motion.rolled_left);
  motion.distance = 0.5 * (left + right);
  motion.turn =
      motion.distance * vehicle::curvature_of(base_, state_.steering + config_.steering_offset) +
      slip.yaw_share * lost_difference / base_.track;
  motion.robot_in_world =
      vehicle::advance_along_arc(state_.robot_in_world, motion.distance, motion.turn);
  return motion;
}

void VehicleDynamics::move(const VehicleMotion& motion, double dt) {
  state_.robot_in_world = motion.robot_in_world;
  state_.velocity = {motion.distance / dt, motion.turn / dt};
}

void VehicleDynamics::halt() {
  state_.speed = 0.0;
  state_.velocity = {};
}

}  // namespace coop::simulator
