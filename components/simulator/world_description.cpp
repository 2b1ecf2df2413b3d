#include "simulator/world_description.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/config/error.hpp"
#include "core/random.hpp"
#include "core/world/shapes.hpp"
#include "simulator/contact.hpp"
#include "simulator/placement.hpp"

namespace coop::simulator {
namespace {

using Eigen::Vector2d;

template <class Inside>
void fill(OccupancyGrid& grid, const Inside& inside) {
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (inside(grid.geometry.center_of(grid.geometry.cell_at(i)))) grid.cells[i] = kOccupied;
  }
}

void add_wall(OccupancyGrid& grid, const WallSegment& wall) {
  const Vector2d from(wall.x1, wall.y1);
  const Vector2d along = Vector2d(wall.x2, wall.y2) - from;
  const double length = along.norm();
  // Never thinner than what keeps a slanted line of cells closed.
  const double half = std::max(0.5 * wall.thickness, 0.75 * grid.geometry.resolution);
  fill(grid, [&](const Vector2d& p) {
    const double t =
        length > 0.0 ? std::clamp((p - from).dot(along) / (length * length), 0.0, 1.0) : 0.0;
    return (p - from - t * along).norm() <= half;
  });
}

void add_box(OccupancyGrid& grid, const SolidBox& box) {
  fill(grid, [&](const Vector2d& p) {
    return p.x() > box.x_min && p.x() < box.x_max && p.y() > box.y_min && p.y() < box.y_max;
  });
}

std::string place_text(double x, double y) {
  return "(" + std::to_string(x) + ", " + std::to_string(y) + ")";
}

void check_unique(std::set<std::string>& names, const std::string& name, const char* what) {
  if (!names.insert(name).second) {
    throw config::Error(std::string("world: two ") + what + " are called '" + name + "'");
  }
}

void check_animals(const WorldDescription& description, const OccupancyGrid& grid) {
  std::set<std::string> names;
  for (const AnimalDescription& animal : description.animals) {
    if (!animal.id.empty()) check_unique(names, animal.id, "animals");
    if (!disc_is_free({animal.x, animal.y}, animal.radius, grid)) {
      throw config::Error("world: animal at " + place_text(animal.x, animal.y) +
                          " does not stand on free floor");
    }
  }
}

std::vector<world::Egg> lay_eggs(const WorldDescription& description, const world::World& world,
                                 const RobotShape& robot) {
  std::vector<world::Egg> eggs;
  std::set<std::string> names;
  const auto lay = [&](const std::string& id, const Vector2d& place) {
    const std::string name = id.empty() ? "egg_" + std::to_string(eggs.size() + 1) : id;
    check_unique(names, name, "eggs");
    eggs.push_back({name, {place.x(), place.y(), world::kEggHalfWidth}, world::EggState::kOnFloor});
  };
  for (const EggPlace& egg : description.eggs) {
    if (!disc_is_free({egg.x, egg.y}, world::kEggHalfLength, world.grid)) {
      throw config::Error("world: egg at " + place_text(egg.x, egg.y) +
                          " does not lie on free floor");
    }
    lay(egg.id, {egg.x, egg.y});
  }
  std::vector<Vector2d> taken;
  for (const world::Egg& egg : eggs) taken.emplace_back(egg.position.head<2>());
  const Quarry quarry{"egg", robot.working_point};
  for (const Vector2d& place :
       place_at_random(description.random_eggs, quarry, world, robot, taken)) {
    lay({}, place);
  }
  return eggs;
}

std::vector<world::Heap> drop_heaps(const WorldDescription& description, const world::World& world,
                                    const RobotShape& robot) {
  std::vector<world::Heap> heaps;
  std::set<std::string> names;
  const auto drop = [&](const std::string& id, const Vector2d& place, double radius) {
    const std::string name = id.empty() ? "heap_" + std::to_string(heaps.size() + 1) : id;
    check_unique(names, name, "heaps");
    heaps.push_back({name, place, radius, world::HeapState::kOnFloor});
  };
  for (const HeapPlace& heap : description.heaps) {
    if (!disc_is_free({heap.x, heap.y}, heap.radius, world.grid)) {
      throw config::Error("world: heap at " + place_text(heap.x, heap.y) +
                          " does not lie on free floor");
    }
    drop(heap.id, {heap.x, heap.y}, heap.radius);
  }
  const RandomHeaps& wanted = description.random_heaps;
  if (wanted.count > 0 && robot.scraper.isEmpty()) {
    throw config::Error("world: random_heaps: the robot has no scraper to get at them");
  }
  std::vector<Vector2d> taken;
  for (const world::Heap& heap : heaps) taken.push_back(heap.position);
  RandomStream sizes(wanted.seed < 0 ? world.seed : static_cast<std::uint64_t>(wanted.seed),
                     "simulator/heap_sizes");
  const Quarry quarry{"heap", robot.scraper.center()};
  for (const Vector2d& place : place_at_random(wanted, quarry, world, robot, taken)) {
    drop({}, place, sizes.uniform(wanted.min_radius, wanted.max_radius));
  }
  return heaps;
}

void check_region(const std::vector<double>& region, const std::string& key) {
  if (!region.empty() && (region.size() != 4 || region[0] >= region[2] || region[1] >= region[3])) {
    throw config::Error("world: " + key + ".region: expected x_min, y_min, x_max, y_max");
  }
}

}  // namespace

void StartPose::describe(config::Fields& fields) {
  fields.number("x", x, {.unit = "m", .help = "base_link in world"});
  fields.number("y", y, {.unit = "m", .help = "base_link in world"});
  fields.number("yaw", yaw, {.unit = "rad", .help = "heading", .min = -6.3, .max = 6.3});
}

void EggPlace::describe(config::Fields& fields) {
  fields.text("id", id, {.help = "name; egg_<number> where empty"});
  fields.number("x", x, {.unit = "m", .help = "in world"});
  fields.number("y", y, {.unit = "m", .help = "in world"});
}

void RandomPlaces::describe(config::Fields& fields) {
  fields.integer("count", count, {.unit = "1", .help = "how many", .min = 0, .max = 1000});
  fields.integer("seed", seed,
                 {.unit = "1", .help = "of their places; -1: that of the simulation", .min = -1});
  fields.numbers("region", region,
                 {.unit = "m", .help = "x_min, y_min, x_max, y_max in world; empty: everywhere"});
  fields.number("wall_clearance", wall_clearance,
                {.unit = "m", .help = "from everything solid", .min = 0.05, .max = 10});
  fields.number("spacing", spacing, {.unit = "m", .help = "between them", .min = 0.1, .max = 10});
  fields.number(
      "lead_in", lead_in,
      {.unit = "m", .help = "free straight way behind where the robot stands", .min = 0, .max = 5});
  fields.number(
      "margin", margin,
      {.unit = "m", .help = "kept free around the robot on that way", .min = 0, .max = 2});
}

void HeapPlace::describe(config::Fields& fields) {
  fields.text("id", id, {.help = "name; heap_<number> where empty"});
  fields.number("x", x, {.unit = "m", .help = "in world"});
  fields.number("y", y, {.unit = "m", .help = "in world"});
  fields.number("radius", radius, {.unit = "m", .help = "of the heap", .min = 0.01, .max = 1});
}

void RandomHeaps::describe(config::Fields& fields) {
  RandomPlaces::describe(fields);
  fields.number("min_radius", min_radius,
                {.unit = "m", .help = "of the smallest", .min = 0.01, .max = 1});
  fields.number("max_radius", max_radius,
                {.unit = "m", .help = "of the largest", .min = 0.01, .max = 1});
}

void RandomAnimals::describe(config::Fields& fields) {
  fields.integer("count", count, {.unit = "1", .help = "how many", .min = 0, .max = 1000});
  fields.integer("seed", seed,
                 {.unit = "1", .help = "of their places; -1: that of the simulation", .min = -1});
  fields.numbers("region", region,
                 {.unit = "m", .help = "x_min, y_min, x_max, y_max in world; empty: everywhere"});
  fields.number("radius", radius, {.unit = "m", .help = "of a disc", .min = 0.02, .max = 2});
  fields.number("speed", speed, {.unit = "m/s", .help = "while walking", .min = 0, .max = 3});
  fields.number("clearance", clearance,
                {.unit = "m", .help = "from walls and each other", .min = 0, .max = 5});
  fields.number("robot_clearance", robot_clearance,
                {.unit = "m", .help = "from the robot's start", .min = 0, .max = 10});
}

void WallSegment::describe(config::Fields& fields) {
  fields.number("x1", x1, {.unit = "m", .help = "one end, in world"});
  fields.number("y1", y1, {.unit = "m", .help = "one end, in world"});
  fields.number("x2", x2, {.unit = "m", .help = "other end, in world"});
  fields.number("y2", y2, {.unit = "m", .help = "other end, in world"});
  fields.number("thickness", thickness,
                {.unit = "m", .help = "of the wall", .min = 0.01, .max = 10});
}

void SolidBox::describe(config::Fields& fields) {
  fields.number("x_min", x_min, {.unit = "m", .help = "in world"});
  fields.number("y_min", y_min, {.unit = "m", .help = "in world"});
  fields.number("x_max", x_max, {.unit = "m", .help = "in world"});
  fields.number("y_max", y_max, {.unit = "m", .help = "in world"});
}

void WorldDescription::describe(config::Fields& fields) {
  fields.text("map", map, {.help = "map YAML, relative to this file"});
  fields.section("robot_start", robot_start);
  fields.list("eggs", eggs);
  fields.section("random_eggs", random_eggs);
  fields.list("heaps", heaps);
  fields.section("random_heaps", random_heaps);
  fields.list("walls", walls);
  fields.list("boxes", boxes);
  fields.list("animals", animals);
  fields.section("random_animals", random_animals);
}

void WorldDescription::validate() const {
  if (map.empty()) throw config::Error("world: 'map' is missing");
  check_region(random_eggs.region, "random_eggs");
  check_region(random_heaps.region, "random_heaps");
  check_region(random_animals.region, "random_animals");
  if (random_heaps.min_radius > random_heaps.max_radius) {
    throw config::Error("world: random_heaps.min_radius: expected no more than max_radius");
  }
}

world::World build_world(const WorldDescription& description, OccupancyGrid map,
                         const RobotShape& robot, std::uint64_t seed) {
  world::World world;
  world.map_path = description.map;
  world.grid = std::move(map);
  for (const WallSegment& wall : description.walls) add_wall(world.grid, wall);
  for (const SolidBox& box : description.boxes) add_box(world.grid, box);
  world.robot_start = {description.robot_start.x, description.robot_start.y,
                       normalize_angle(description.robot_start.yaw)};
  world.seed = seed;
  std::vector<Vector2d> outline;
  place(robot.footprint, world.robot_start, outline);
  if (!disc_is_free(world.robot_start.position(), 0.5 * world.grid.geometry.resolution,
                    world.grid) ||
      outline_hits_grid(outline, world.grid)) {
    throw config::Error("world: the robot's start " +
                        place_text(world.robot_start.x, world.robot_start.y) +
                        " does not lie on free floor");
  }
  check_animals(description, world.grid);
  world.eggs = lay_eggs(description, world, robot);
  world.heaps = drop_heaps(description, world, robot);
  return world;
}

}  // namespace coop::simulator
