#include "simulator/flock.hpp"

#include <cmath>
#include <numbers>

#include "simulator/contact.hpp"

namespace coop::simulator {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

double exponential(RandomStream& random, double mean) {
  return -mean * std::log(1.0 - random.uniform());
}

}  // namespace

void AnimalDescription::describe(config::Fields& fields) {
  fields.text("id", id, {.help = "name; animal_<number> where empty"});
  fields.number("x", x, {.unit = "m", .help = "start, in world"});
  fields.number("y", y, {.unit = "m", .help = "start, in world"});
  fields.number("radius", radius, {.unit = "m", .help = "of its disc", .min = 0.02, .max = 2});
  fields.number("speed", speed, {.unit = "m/s", .help = "while walking", .min = 0, .max = 3});
}

void FlockConfig::describe(config::Fields& fields) {
  fields.number("wandering", wandering,
                {.unit = "rad/sqrt(s)", .help = "random walk of the heading", .min = 0, .max = 10});
  fields.number("mean_walk", mean_walk,
                {.unit = "s", .help = "mean time between rests", .min = 0.1, .max = 1e6});
  fields.number("mean_rest", mean_rest, {.unit = "s", .help = "mean rest", .min = 0, .max = 1e6});
  fields.number("wall_clearance", wall_clearance,
                {.unit = "m", .help = "kept from walls", .min = 0, .max = 2});
  fields.flag("stop_before_robot", stop_before_robot,
              {.help = "animals stand still near the robot; else they walk up to it"});
  fields.number("robot_clearance", robot_clearance,
                {.unit = "m", .help = "at which they stand still", .min = 0, .max = 5});
}

Flock::Flock(const FlockConfig& config, const std::vector<AnimalDescription>& animals,
             std::uint64_t seed)
    : config_(config) {
  for (std::size_t i = 0; i < animals.size(); ++i) {
    const AnimalDescription& description = animals[i];
    const std::string id =
        description.id.empty() ? "animal_" + std::to_string(i + 1) : description.id;
    animals_.push_back({id, {description.x, description.y}, {0, 0}, description.radius});
    RandomStream random(seed, "simulator/animal/" + id);
    const double heading = random.uniform(-kPi, kPi);
    const double until_change = exponential(random, config.mean_walk);
    walks_.push_back({random, description.speed, heading, until_change});
  }
}

bool Flock::is_free(std::size_t who, const Vector2d& place, const OccupancyGrid& grid,
                    std::span<const Vector2d> robot) const {
  const world::Animal& animal = animals_[who];
  if (!disc_is_free(place, animal.radius + config_.wall_clearance, grid)) return false;
  // Never onto the robot or one another; away from what is too near already is allowed.
  const auto nearer_than = [&](double now, double then, double limit) {
    return then < limit && then <= now;
  };
  const double robot_limit =
      animal.radius + (config_.stop_before_robot ? config_.robot_clearance : 0.01);
  if (nearer_than(distance_to_outline(robot, animal.position), distance_to_outline(robot, place),
                  robot_limit)) {
    return false;
  }
  for (std::size_t other = 0; other < animals_.size(); ++other) {
    if (other == who) continue;
    const Vector2d& there = animals_[other].position;
    if (nearer_than((animal.position - there).norm(), (place - there).norm(),
                    animal.radius + animals_[other].radius)) {
      return false;
    }
  }
  return true;
}

void Flock::step(double dt, const OccupancyGrid& grid, std::span<const Vector2d> robot) {
  for (std::size_t i = 0; i < animals_.size(); ++i) {
    world::Animal& animal = animals_[i];
    Walk& walk = walks_[i];
    walk.until_change -= dt;
    if (walk.until_change <= 0.0) {
      walk.resting = !walk.resting;
      walk.until_change =
          exponential(walk.random, walk.resting ? config_.mean_rest : config_.mean_walk);
    }
    animal.velocity = {0, 0};
    if (walk.resting) continue;
    walk.heading =
        normalize_angle(walk.heading + walk.random.normal(0.0, config_.wandering * std::sqrt(dt)));
    const Vector2d velocity = walk.speed * Vector2d(std::cos(walk.heading), std::sin(walk.heading));
    const Vector2d place = animal.position + dt * velocity;
    if (is_free(i, place, grid, robot)) {
      animal.position = place;
      animal.velocity = velocity;
    } else {
      walk.heading = walk.random.uniform(-kPi, kPi);  // looks for another way
    }
  }
}

}  // namespace coop::simulator
