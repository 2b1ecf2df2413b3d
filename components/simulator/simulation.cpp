#include "simulator/simulation.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/costmap/footprint.hpp"
#include "core/hash.hpp"
#include "simulator/archive.hpp"
#include "simulator/contact.hpp"

namespace coop::simulator {
namespace {

/// A contact lasts until the robot is this far away, m: pushing on against a wall is one collision.
constexpr double kContactEnd = 0.03;

/// Tells worlds apart, so that nobody resumes in another one.
class Fingerprint {
 public:
  void add(const void* data, std::size_t bytes) {
    hash_.add(std::string_view(static_cast<const char*>(data), bytes));
  }
  void add(const std::string& text) { add(text.data(), text.size() + 1); }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void add(Number value) { add(&value, sizeof value); }
  [[nodiscard]] std::uint64_t value() const { return hash_.value(); }

 private:
  Fnv1a hash_;
};

std::uint64_t fingerprint_of(const world::World& world, const std::vector<world::Animal>& animals) {
  Fingerprint print;
  print.add(world.seed);
  print.add(world.grid.geometry.width);
  print.add(world.grid.geometry.resolution);
  print.add(world.grid.cells.data(), world.grid.cells.size());
  for (const double value : {world.robot_start.x, world.robot_start.y, world.robot_start.yaw}) {
    print.add(value);
  }
  for (const world::Egg& egg : world.eggs) {
    print.add(egg.id);
    print.add(egg.position.x());
    print.add(egg.position.y());
  }
  for (const world::Heap& heap : world.heaps) {
    print.add(heap.id);
    print.add(heap.position.x());
    print.add(heap.position.y());
    print.add(heap.radius);
  }
  for (const world::Animal& animal : animals) {
    print.add(animal.id);
    print.add(animal.radius);
    print.add(animal.position.x());
    print.add(animal.position.y());
  }
  return print.value();
}

}  // namespace

void SimulationConfig::describe(config::Fields& fields) {
  fields.section("drive", drive);
  fields.section("vehicle", vehicle);
  fields.section("wheel_sensor", wheel_sensor);
  fields.section("imu", imu);
  fields.section("eggs", eggs);
  fields.section("animals", animals);
}

Simulation::Simulation(const SimulationConfig& config, const RobotShape& robot,
                       const world::World& world, const std::vector<AnimalDescription>& animals)
    : grid_(world.grid),
      robot_(robot),
      drive_(config.drive, robot.base),
      vehicle_(config.vehicle, robot.base, world.robot_start, world.seed),
      wheels_(config.wheel_sensor, robot.base, world.seed),
      imu_(config.imu, robot.imu_in_base, world.seed),
      eggs_(config.eggs, robot, world.eggs),
      heaps_(robot.scraper, world.heaps),
      flock_(config.animals, animals, world.seed),
      grown_footprint_(Footprint(robot.footprint, kContactEnd).vertices()) {
  fingerprint_ = fingerprint_of(world, flock_.animals());
  wheels_.read(vehicle_.state().steering, now());
  imu_reading_ = imu_.read({}, {}, to_seconds(kTick), now());
  place(robot_.footprint, vehicle_.state().robot_in_world, outline_);
  update_truth();
}

Simulation::Contact Simulation::contact_of(std::span<const Eigen::Vector2d> outline) const {
  const auto& animals = flock_.animals();
  const bool touches = std::any_of(animals.begin(), animals.end(), [&](const auto& animal) {
    return distance_to_outline(outline, animal.position) < animal.radius;
  });
  if (touches) return Contact::kAnimal;
  return outline_hits_grid(outline, grid_) ? Contact::kWall : Contact::kNone;
}

Simulation::Contact Simulation::contact_nearby() {
  place(grown_footprint_, vehicle_.state().robot_in_world, grown_outline_);
  return contact_of(grown_outline_);
}

void Simulation::count(Contact contact) {
  if (in_collision_) return;
  in_collision_ = true;
  ++collision_count_;
  if (contact == Contact::kAnimal) ++animal_collision_count_;
}

void Simulation::drive() {
  const double dt = to_seconds(kTick);
  const vehicle::DriveSetpoint setpoint = drive_.step(now(), kTick);
  const Twist2 before = vehicle_.state().velocity;
  const VehicleMotion motion = vehicle_.roll(setpoint, dt);
  place(robot_.footprint, motion.robot_in_world, outline_);
  const Contact contact = motion.distance != 0.0 ? contact_of(outline_) : Contact::kNone;
  if (contact != Contact::kNone) {
    count(contact);
    vehicle_.halt();
    drive_.reset({0.0, setpoint.steering, setpoint.cause});
    place(robot_.footprint, vehicle_.state().robot_in_world, outline_);
  } else {
    vehicle_.move(motion, dt);
    wheels_.roll(motion.rolled_left, motion.rolled_right);
    if (in_collision_) in_collision_ = contact_nearby() != Contact::kNone;
  }
  imu_reading_ = imu_.read(before, vehicle_.state().velocity, dt, now());
}

void Simulation::step() {
  ++tick_;
  const Pose2 before = vehicle_.state().robot_in_world;
  drive();
  if (has_new_reading()) wheels_.read(vehicle_.state().steering, now());
  flock_.step(to_seconds(kTick), grid_, outline_);
  eggs_.step(vehicle_.state().robot_in_world, vehicle_.state().steering, gripper_);
  heaps_.step(before, vehicle_.state().robot_in_world);
  update_truth();
}

void Simulation::update_truth() {
  truth_.stamp = now();
  truth_.robot_in_world = vehicle_.state().robot_in_world;
  truth_.velocity = vehicle_.state().velocity;
  truth_.steering_angle = vehicle_.state().steering;
  truth_.in_collision = in_collision_;
  truth_.collision_count = collision_count_;
  truth_.animal_collision_count = animal_collision_count_;
  truth_.eggs = eggs_.eggs();
  truth_.animals = flock_.animals();
  truth_.heaps = heaps_.heaps();
}

template <class Archive>
void Simulation::persist(Archive& archive) {
  vehicle::DriveSetpoint setpoint = drive_.setpoint();
  archive(tick_, setpoint.speed, setpoint.steering, setpoint.cause, vehicle_, wheels_, imu_, eggs_,
          heaps_, flock_, gripper_.suction, gripper_.tip_in_base, in_collision_, collision_count_,
          animal_collision_count_, imu_reading_.angular_velocity, imu_reading_.linear_acceleration);
  drive_.reset(setpoint);
}

void Simulation::store(std::string& out) {
  ArchiveWriter archive(out);
  archive(fingerprint_);
  persist(archive);
}

void Simulation::restore(std::string_view stored) {
  ArchiveReader archive(stored);
  std::uint64_t fingerprint = 0;
  archive(fingerprint);
  if (fingerprint != fingerprint_) {
    throw std::runtime_error("the stored state belongs to another world");
  }
  persist(archive);
  place(robot_.footprint, vehicle_.state().robot_in_world, outline_);
  imu_reading_.stamp = now();
  update_truth();
}

}  // namespace coop::simulator
