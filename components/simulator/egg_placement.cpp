#include "simulator/egg_placement.hpp"

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

/// Finds out whether an egg at some place can be picked.
class ApproachCheck {
 public:
  ApproachCheck(const RandomEggs& wanted, const world::World& world, const RobotShape& robot)
      : wanted_(wanted), world_(world), robot_(robot) {
    const Footprint body(robot.footprint, wanted.margin);
    body_ = body.vertices();
    reachable_ = reachable_floor(world, body.half_width());
  }

  [[nodiscard]] bool possible(const Vector2d& egg) {
    constexpr int kHeadings = 24;
    for (int i = 0; i < kHeadings; ++i) {
      if (possible_at(egg, 2.0 * std::numbers::pi * i / kHeadings)) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] bool possible_at(const Vector2d& egg, double heading) {
    constexpr double kStep = 0.1;
    const Vector2d forward(std::cos(heading), std::sin(heading));
    const Vector2d picking = Pose2{egg.x(), egg.y(), heading} * Vector2d(-robot_.working_point);
    for (double back = 0.0; back <= wanted_.lead_in + 1e-9; back += kStep) {
      const Vector2d place_back = picking - back * forward;
      if (reachable_.at_or(reachable_.geometry.cell_of(place_back), 0) == 0) return false;
      place(body_, {place_back.x(), place_back.y(), heading}, placed_);
      if (outline_hits_grid(placed_, world_.grid)) return false;
    }
    return true;
  }

  const RandomEggs& wanted_;
  const world::World& world_;
  const RobotShape& robot_;
  std::vector<Vector2d> body_;
  std::vector<Vector2d> placed_;
  Grid<std::uint8_t> reachable_;
};

}  // namespace

std::vector<Vector2d> place_eggs(const RandomEggs& wanted, const world::World& world,
                                 const RobotShape& robot, const std::vector<Vector2d>& taken) {
  std::vector<Vector2d> places;
  if (wanted.count == 0) return places;
  const GridGeometry& geometry = world.grid.geometry;
  Vector2d low = geometry.origin;
  Vector2d high = low + geometry.resolution * Vector2d(geometry.width, geometry.height);
  if (!wanted.region.empty()) {
    low = low.cwiseMax(Vector2d(wanted.region[0], wanted.region[1]));
    high = high.cwiseMin(Vector2d(wanted.region[2], wanted.region[3]));
  }
  const std::uint64_t seed = wanted.seed < 0 ? world.seed : static_cast<std::uint64_t>(wanted.seed);
  RandomStream random(seed, "simulator/egg_places");
  ApproachCheck approach(wanted, world, robot);
  std::vector<Vector2d> start;
  place(robot.footprint, world.robot_start, start);

  const auto wanted_count = static_cast<std::size_t>(wanted.count);
  const int tries = 2000 + 500 * wanted.count;
  for (int i = 0; i < tries && places.size() < wanted_count; ++i) {
    const double x = random.uniform(low.x(), high.x());
    const double y = random.uniform(low.y(), high.y());
    const Vector2d egg(x, y);
    const auto near = [&](const Vector2d& other) { return (other - egg).norm() < wanted.spacing; };
    if (!disc_is_free(egg, wanted.wall_clearance, world.grid)) continue;
    if (std::any_of(places.begin(), places.end(), near)) continue;
    if (std::any_of(taken.begin(), taken.end(), near)) continue;
    if (distance_to_outline(start, egg) < wanted.spacing) continue;
    if (approach.possible(egg)) places.push_back(egg);
  }
  if (places.size() < wanted_count) {
    throw config::Error("world: random_eggs: room was found for " + std::to_string(places.size()) +
                        " of " + std::to_string(wanted.count) + " eggs only");
  }
  return places;
}

}  // namespace coop::simulator
