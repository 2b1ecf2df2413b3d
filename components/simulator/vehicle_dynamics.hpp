#pragma once
#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/random.hpp"
#include "core/vehicle/ackermann.hpp"
#include "core/vehicle/drive_controller.hpp"

namespace coop::simulator {

/// Wheels on litter: ground travelled = rolled * (1 - slip) + random * sqrt(rolled) * N(0, 1), for
/// each rear wheel on its own.
struct SlipConfig {
  double left = 0.004;    ///< share of the rolled distance that is lost
  double right = 0.007;   ///< the same on the right
  double random = 0.004;  ///< m per sqrt(m)
  double yaw_share =
      0.25;  ///< of the wheels' difference that turns the body; the front tyres hold the rest

  void describe(config::Fields& fields);
};

/// Actuators that do not do quite as they are told: errors of the set points that wander
/// (first-order Gauss-Markov), and an adjustment of the steering that is drawn once a run. None by
/// default.
struct ActuatorErrorConfig {
  double speed = 0.0;             ///< share of the speed, deviation
  double steering = 0.0;          ///< rad, deviation
  double correlation_time = 1.0;  ///< s
  double steering_offset = 0.0;   ///< rad, deviation over runs; on top of VehicleConfig's

  void describe(config::Fields& fields);
};

struct VehicleConfig {
  double speed_time_constant =
      0.12;  ///< s, first-order lag of the drive motor behind its set point
  double steering_time_constant = 0.08;  ///< s, the same of the steering
  double steering_offset = 0.0;          ///< rad, true minus indicated angle: badly adjusted rods
  SlipConfig slip;
  ActuatorErrorConfig actuators;

  void describe(config::Fields& fields);
};

struct VehicleState {
  Pose2 robot_in_world;
  Twist2 velocity;              ///< over ground, in base_link
  double speed = 0.0;           ///< at which the drive rolls, m/s at base_link
  double steering = 0.0;        ///< as indicated, rad
  double speed_error = 0.0;     ///< of the drive's set point, as a share
  double steering_error = 0.0;  ///< of the steering's set point, rad
};

/// What happened in one tick.
struct VehicleMotion {
  Pose2 robot_in_world;       ///< where it leads
  double distance = 0.0;      ///< over ground, m
  double turn = 0.0;          ///< over ground, rad
  double rolled_left = 0.0;   ///< by the rear wheels, m: what encoders see
  double rolled_right = 0.0;  ///< m
};

/// The true base: actuators that lag behind their set points, wheels that slip. Whether the motion
/// can take place (walls) is decided by the simulation, between roll() and move() or halt().
class VehicleDynamics {
 public:
  VehicleDynamics(const VehicleConfig& config, const vehicle::AckermannGeometry& base,
                  const Pose2& start, std::uint64_t seed);

  /// Moves the actuators for `dt` seconds and tells the motion that follows.
  VehicleMotion roll(const vehicle::DriveSetpoint& setpoint, double dt);
  /// The motion took place.
  void move(const VehicleMotion& motion, double dt);
  /// The robot ran into something: it stands, and the wheels are blocked.
  void halt();

  [[nodiscard]] const VehicleState& state() const { return state_; }

  template <class Archive>
  void persist(Archive& archive) {
    archive(state_, slip_noise_, actuator_noise_);
  }

 private:
  void wander(double dt);

  VehicleConfig config_;
  vehicle::AckermannGeometry base_;
  VehicleState state_;
  RandomStream slip_noise_;
  RandomStream actuator_noise_;
};

}  // namespace coop::simulator
