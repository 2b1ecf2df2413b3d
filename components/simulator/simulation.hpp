#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/fields.hpp"
#include "core/imu_reading.hpp"
#include "core/vehicle/drive_controller.hpp"
#include "core/world/state.hpp"
#include "simulator/egg_field.hpp"
#include "simulator/flock.hpp"
#include "simulator/heap_field.hpp"
#include "simulator/robot_shape.hpp"
#include "simulator/sensors.hpp"
#include "simulator/vehicle_dynamics.hpp"

namespace coop::simulator {

struct SimulationConfig {
  vehicle::DriveConfig drive;
  VehicleConfig vehicle;
  WheelSensorConfig wheel_sensor;
  ImuConfig imu;
  EggConfig eggs;
  FlockConfig animals;

  void describe(config::Fields& fields);
};

/// A world and a robot in it, advanced in ticks of fixed length. Inputs act from the next tick on;
/// the same inputs before the same ticks, with the same seed, give the same state to the bit. Knows
/// no clock: the first state is that of kStart.
class Simulation {
 public:
  static constexpr Duration kTick = std::chrono::milliseconds(10);
  /// Time zero would mean "never set".
  static constexpr Time kStart = Time(std::chrono::seconds(1));
  /// Odometry is read every second tick: 50 Hz.
  static constexpr std::uint64_t kTicksPerReading = 2;

  Simulation(const SimulationConfig& config, const RobotShape& robot, const world::World& world,
             const std::vector<AnimalDescription>& animals);

  /// Velocity commands and emergency stops; arrival times are now().
  [[nodiscard]] vehicle::CommandGate& gate() { return drive_.gate(); }
  [[nodiscard]] const vehicle::DriveSetpoint& setpoint() const { return drive_.setpoint(); }
  void set_gripper(const GripperInput& gripper) { gripper_ = gripper; }

  void step();

  [[nodiscard]] std::uint64_t tick() const { return tick_; }
  [[nodiscard]] Time now() const { return kStart + static_cast<std::int64_t>(tick_) * kTick; }
  /// True at the ticks with new odometry.
  [[nodiscard]] bool has_new_reading() const { return tick_ % kTicksPerReading == 0; }

  [[nodiscard]] const world::GroundTruth& ground_truth() const { return truth_; }
  [[nodiscard]] const vehicle::WheelOdometry& odometry() const { return wheels_.odometry(); }
  [[nodiscard]] const ImuReading& imu() const { return imu_reading_; }

  /// Appends the state as bytes, for the journal.
  void store(std::string& out);
  /// Goes on from a stored state. Throws std::runtime_error, and changes nothing, where it is that
  /// of another world.
  void restore(std::string_view stored);

 private:
  enum class Contact { kNone, kAnimal, kWall };

  void drive();
  void update_truth();
  [[nodiscard]] Contact contact_of(std::span<const Eigen::Vector2d> outline) const;
  [[nodiscard]] Contact contact_nearby();
  void count(Contact contact);
  template <class Archive>
  void persist(Archive& archive);

  OccupancyGrid grid_;
  RobotShape robot_;
  std::uint64_t fingerprint_;
  vehicle::DriveController drive_;
  VehicleDynamics vehicle_;
  WheelSensor wheels_;
  ImuSensor imu_;
  EggField eggs_;
  HeapField heaps_;
  Flock flock_;
  GripperInput gripper_;
  std::uint64_t tick_ = 0;
  bool in_collision_ = false;
  std::uint32_t collision_count_ = 0;
  std::uint32_t animal_collision_count_ = 0;
  ImuReading imu_reading_;
  world::GroundTruth truth_;
  std::vector<Eigen::Vector2d> outline_;          ///< of the robot in world
  std::vector<Eigen::Vector2d> grown_footprint_;  ///< in base_link
  std::vector<Eigen::Vector2d> grown_outline_;    ///< in world
};

}  // namespace coop::simulator
