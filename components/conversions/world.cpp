#include "conversions/world.hpp"

#include <cmath>

#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "conversions/time.hpp"

namespace coop::conversions {
namespace {

std::vector<coop_msgs::msg::SimEgg> to_msgs(const std::vector<world::Egg>& eggs) {
  std::vector<coop_msgs::msg::SimEgg> messages(eggs.size());
  for (std::size_t i = 0; i < eggs.size(); ++i) {
    messages[i].id(eggs[i].id);
    messages[i].position(to_point_msg(eggs[i].position));
    messages[i].state(static_cast<std::uint8_t>(eggs[i].state));
  }
  return messages;
}

Result<std::vector<world::Egg>> from_msgs(const std::vector<coop_msgs::msg::SimEgg>& messages) {
  std::vector<world::Egg> eggs;
  eggs.reserve(messages.size());
  for (const auto& message : messages) {
    const auto position = from_msg(message.position());
    if (!position) return fail("egg " + message.id() + ": " + position.error());
    if (message.state() > static_cast<std::uint8_t>(world::EggState::kBroken)) {
      return fail("egg " + message.id() + ": unknown state");
    }
    eggs.push_back({message.id(), *position, static_cast<world::EggState>(message.state())});
  }
  return eggs;
}

std::vector<coop_msgs::msg::SimAnimal> to_msgs(const std::vector<world::Animal>& animals) {
  std::vector<coop_msgs::msg::SimAnimal> messages(animals.size());
  for (std::size_t i = 0; i < animals.size(); ++i) {
    const world::Animal& animal = animals[i];
    messages[i].id(animal.id);
    messages[i].position(to_point_msg({animal.position.x(), animal.position.y(), 0.0}));
    messages[i].velocity(to_vector_msg({animal.velocity.x(), animal.velocity.y(), 0.0}));
    messages[i].radius(animal.radius);
  }
  return messages;
}

Result<std::vector<world::Animal>> from_msgs(
    const std::vector<coop_msgs::msg::SimAnimal>& messages) {
  std::vector<world::Animal> animals;
  animals.reserve(messages.size());
  for (const auto& message : messages) {
    const auto position = from_msg(message.position());
    if (!position) return fail("animal " + message.id() + ": " + position.error());
    const auto velocity = from_msg(message.velocity());
    if (!velocity) return fail("animal " + message.id() + ": " + velocity.error());
    if (!(std::isfinite(message.radius()) && message.radius() >= 0.0)) {
      return fail("animal " + message.id() + ": radius is not a length");
    }
    animals.push_back({message.id(), position->head<2>(), velocity->head<2>(), message.radius()});
  }
  return animals;
}

std::vector<coop_msgs::msg::SimHeap> to_msgs(const std::vector<world::Heap>& heaps) {
  std::vector<coop_msgs::msg::SimHeap> messages(heaps.size());
  for (std::size_t i = 0; i < heaps.size(); ++i) {
    messages[i].id(heaps[i].id);
    messages[i].position(to_point_msg({heaps[i].position.x(), heaps[i].position.y(), 0.0}));
    messages[i].radius(heaps[i].radius);
    messages[i].state(static_cast<std::uint8_t>(heaps[i].state));
  }
  return messages;
}

Result<std::vector<world::Heap>> from_msgs(const std::vector<coop_msgs::msg::SimHeap>& messages) {
  std::vector<world::Heap> heaps;
  heaps.reserve(messages.size());
  for (const auto& message : messages) {
    const auto position = from_msg(message.position());
    if (!position) return fail("heap " + message.id() + ": " + position.error());
    if (!(std::isfinite(message.radius()) && message.radius() >= 0.0)) {
      return fail("heap " + message.id() + ": radius is not a length");
    }
    if (message.state() > static_cast<std::uint8_t>(world::HeapState::kCleaned)) {
      return fail("heap " + message.id() + ": unknown state");
    }
    heaps.push_back({message.id(), position->head<2>(), message.radius(),
                     static_cast<world::HeapState>(message.state())});
  }
  return heaps;
}

}  // namespace

coop_msgs::msg::World to_msg(const world::World& world, Time stamp) {
  coop_msgs::msg::World message;
  message.header(to_header(stamp, kWorldFrame));
  message.map_path(world.map_path);
  message.grid(to_msg(Stamped<OccupancyGrid>{stamp, kWorldFrame, world.grid}));
  message.eggs(to_msgs(world.eggs));
  message.robot_start(to_msg(world.robot_start));
  message.seed(world.seed);
  message.heaps(to_msgs(world.heaps));
  return message;
}

Result<world::World> from_msg(const coop_msgs::msg::World& message) {
  auto grid = from_msg(message.grid());
  if (!grid) return fail(std::move(grid.error()));
  auto eggs = from_msgs(message.eggs());
  if (!eggs) return fail(std::move(eggs.error()));
  const auto start = pose2_from_msg(message.robot_start());
  if (!start) return fail("start of the robot: " + start.error());
  auto heaps = from_msgs(message.heaps());
  if (!heaps) return fail(std::move(heaps.error()));
  return world::World{message.map_path(), std::move(grid->value), std::move(*eggs), *start,
                      message.seed(),     std::move(*heaps)};
}

coop_msgs::msg::GroundTruth to_msg(const world::GroundTruth& truth) {
  coop_msgs::msg::GroundTruth message;
  message.header(to_header(truth.stamp, kWorldFrame));
  message.robot(to_msg(truth.robot_in_world));
  message.velocity(to_msg(truth.velocity));
  message.steering_angle(truth.steering_angle);
  message.in_collision(truth.in_collision);
  message.collision_count(truth.collision_count);
  message.animal_collision_count(truth.animal_collision_count);
  message.eggs(to_msgs(truth.eggs));
  message.animals(to_msgs(truth.animals));
  message.heaps(to_msgs(truth.heaps));
  return message;
}

Result<world::GroundTruth> from_msg(const coop_msgs::msg::GroundTruth& message) {
  const auto stamp = from_msg(message.header().stamp());
  if (!stamp) return fail(stamp.error());
  const auto robot = pose2_from_msg(message.robot());
  if (!robot) return fail("robot: " + robot.error());
  const auto velocity = from_msg(message.velocity());
  if (!velocity) return fail("robot: " + velocity.error());
  if (!std::isfinite(message.steering_angle())) return fail("steering angle is not finite");
  auto eggs = from_msgs(message.eggs());
  if (!eggs) return fail(std::move(eggs.error()));
  auto animals = from_msgs(message.animals());
  if (!animals) return fail(std::move(animals.error()));
  auto heaps = from_msgs(message.heaps());
  if (!heaps) return fail(std::move(heaps.error()));
  return world::GroundTruth{.stamp = *stamp,
                            .robot_in_world = *robot,
                            .velocity = *velocity,
                            .steering_angle = message.steering_angle(),
                            .in_collision = message.in_collision(),
                            .collision_count = message.collision_count(),
                            .animal_collision_count = message.animal_collision_count(),
                            .eggs = std::move(*eggs),
                            .animals = std::move(*animals),
                            .heaps = std::move(*heaps)};
}

}  // namespace coop::conversions
