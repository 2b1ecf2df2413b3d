#include "simulator/placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/config/error.hpp"
#include "core/costmap/distance_transform.hpp"
#include "core/costmap/footprint.hpp"
#include "core/random.hpp"
#include "simulator/contact.hpp"

namespace coop::simulator {
namespace {

using Eigen::Vector2d;

/// Cells that base_link can be brought to from its start: connected floor whose distance from
/// everything solid or unknown is at least `clearance` metres.
Grid<std::uint8_t> reachable_floor(const world::World& world, double clearance) {
  OccupancyGrid solid = world.grid;
  for (auto& cell : solid.cells) {
    cell = cell == kUnknown || world::is_occupied(cell) ? kOccupied : kFree;
  }
  const Grid<float> distance = distance_to_occupied(solid, clearance + solid.geometry.resolution);
  Grid<std::uint8_t> reached(solid.geometry, 0);
  std::vector<Cell> open{solid.geometry.cell_of(world.robot_start.position())};
  reached[open.front()] = 1;
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    for (const Cell next : {Cell{cell.x + 1, cell.y}, Cell{cell.x - 1, cell.y},
                            Cell{cell.x, cell.y + 1}, Cell{cell.x, cell.y - 1}}) {
      if (!solid.geometry.contains(next) || reached[next] != 0) continue;
      if (static_cast<double>(distance[next]) < clearance) continue;
      reached[next] = 1;
      open.push_back(next);
    }
  }
  return reached;
}

/// Finds out whether the robot can get at some place.
class ApproachCheck {
 public:
  ApproachCheck(const RandomPlaces& wanted, const Eigen::Vector2d& place_in_base,
                const world::World& world, const RobotShape& robot)
      : wanted_(wanted), place_in_base_(place_in_base), world_(world) {
    const Footprint body(robot.footprint, wanted.margin);
    body_ = body.vertices();
    reachable_ = reachable_floor(world, body.half_width());
  }

  [[nodiscard]] bool possible(const Vector2d& target) {
    constexpr int kHeadings = 24;
    for (int i = 0; i < kHeadings; ++i) {
      if (possible_at(target, 2.0 * std::numbers::pi * i / kHeadings)) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] bool possible_at(const Vector2d& target, double heading) {
    constexpr double kStep = 0.1;
    const Vector2d forward(std::cos(heading), std::sin(heading));
    const Vector2d standing = Pose2{target.x(), target.y(), heading} * Vector2d(-place_in_base_);
    for (double back = 0.0; back <= wanted_.lead_in + 1e-9; back += kStep) {
      const Vector2d place_back = standing - back * forward;
      if (reachable_.at_or(reachable_.geometry.cell_of(place_back), 0) == 0) return false;
      place(body_, {place_back.x(), place_back.y(), heading}, placed_);
      if (outline_hits_grid(placed_, world_.grid)) return false;
    }
    return true;
  }

  const RandomPlaces& wanted_;
  Vector2d place_in_base_;
  const world::World& world_;
  std::vector<Vector2d> body_;
  std::vector<Vector2d> placed_;
  Grid<std::uint8_t> reachable_;
};

/// The rectangle that random places come from.
Eigen::AlignedBox2d region_of(const std::vector<double>& region, const GridGeometry& geometry) {
  const Vector2d low = geometry.origin;
  Eigen::AlignedBox2d box(low,
                          low + geometry.resolution * Vector2d(geometry.width, geometry.height));
  if (!region.empty()) {
    box = box.intersection(
        Eigen::AlignedBox2d(Vector2d(region[0], region[1]), Vector2d(region[2], region[3])));
  }
  return box;
}

Vector2d draw_place(RandomStream& random, const Eigen::AlignedBox2d& region) {
  const double x = random.uniform(region.min().x(), region.max().x());
  const double y = random.uniform(region.min().y(), region.max().y());
  return {x, y};
}

[[noreturn]] void refuse(const std::string& name, std::size_t found, int count) {
  throw config::Error("world: random_" + name + "s: room was found for " + std::to_string(found) +
                      " of " + std::to_string(count) + " " + name + "s only");
}

std::uint64_t seed_of(std::int64_t own, const world::World& world) {
  return own < 0 ? world.seed : static_cast<std::uint64_t>(own);
}

}  // namespace

std::vector<Vector2d> place_at_random(const RandomPlaces& wanted, const Quarry& quarry,
                                      const world::World& world, const RobotShape& robot,
                                      const std::vector<Vector2d>& taken) {
  std::vector<Vector2d> places;
  if (wanted.count == 0) return places;
  const Eigen::AlignedBox2d region = region_of(wanted.region, world.grid.geometry);
  RandomStream random(seed_of(wanted.seed, world), "simulator/" + quarry.name + "_places");
  ApproachCheck approach(wanted, quarry.place_in_base, world, robot);
  std::vector<Vector2d> start;
  place(robot.footprint, world.robot_start, start);

  const auto wanted_count = static_cast<std::size_t>(wanted.count);
  const int tries = 2000 + 500 * wanted.count;
  for (int i = 0; i < tries && places.size() < wanted_count; ++i) {
    const Vector2d drawn = draw_place(random, region);
    const auto near = [&](const Vector2d& other) {
      return (other - drawn).norm() < wanted.spacing;
    };
    if (!disc_is_free(drawn, wanted.wall_clearance, world.grid)) continue;
    if (std::any_of(places.begin(), places.end(), near)) continue;
    if (std::any_of(taken.begin(), taken.end(), near)) continue;
    if (distance_to_outline(start, drawn) < wanted.spacing) continue;
    if (approach.possible(drawn)) places.push_back(drawn);
  }
  if (places.size() < wanted_count) refuse(quarry.name, places.size(), wanted.count);
  return places;
}

std::vector<AnimalDescription> place_animals(const WorldDescription& description,
                                             const world::World& world, const RobotShape& robot) {
  std::vector<AnimalDescription> animals = description.animals;
  const RandomAnimals& wanted = description.random_animals;
  if (wanted.count == 0) return animals;
  const Eigen::AlignedBox2d region = region_of(wanted.region, world.grid.geometry);
  RandomStream random(seed_of(wanted.seed, world), "simulator/animal_places");
  std::vector<Vector2d> start;
  place(robot.footprint, world.robot_start, start);
  const std::size_t wanted_count = animals.size() + static_cast<std::size_t>(wanted.count);
  for (int i = 0; i < 1000 * wanted.count && animals.size() < wanted_count; ++i) {
    const Vector2d drawn = draw_place(random, region);
    const bool beside_another =
        std::any_of(animals.begin(), animals.end(), [&](const AnimalDescription& other) {
          return (Vector2d(other.x, other.y) - drawn).norm() <
                 other.radius + wanted.radius + wanted.clearance;
        });
    if (beside_another || !disc_is_free(drawn, wanted.radius + wanted.clearance, world.grid) ||
        distance_to_outline(start, drawn) < wanted.radius + wanted.robot_clearance) {
      continue;
    }
    animals.push_back({{}, drawn.x(), drawn.y(), wanted.radius, wanted.speed});
  }
  if (animals.size() < wanted_count) {
    refuse("animal", animals.size() - description.animals.size(), wanted.count);
  }
  return animals;
}

}  // namespace coop::simulator
