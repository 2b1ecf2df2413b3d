#include "global_planner/animal_layer.hpp"

#include <algorithm>
#include <cmath>

namespace coop::global_planner {
namespace {

constexpr double kUnderRobot = 0.05;  ///< m around the footprint

}  // namespace

void AnimalLayerConfig::describe(config::Fields& fields) {
  fields.number("horizon", horizon,
                {.unit = "s", .help = "an animal's way is predicted so far", .min = 0, .max = 10});
  AnimalTracksConfig::describe(fields);
}

void AnimalLayer::cover(const GridGeometry& grid, Time now,
                        const std::optional<Pose2>& robot_in_map, const Footprint& footprint,
                        std::vector<std::size_t>& cells) const {
  const std::optional<Pose2> map_in_robot =
      robot_in_map ? std::optional(robot_in_map->inverse()) : std::nullopt;
  const auto add = [&](const AnimalTracks::Disc& disc) {
    const Eigen::Vector2d reach(disc.radius, disc.radius);
    const Cell low = grid.cell_of(disc.center - reach);
    const Cell high = grid.cell_of(disc.center + reach);
    for (int y = std::max(low.y, 0); y <= std::min(high.y, grid.height - 1); ++y) {
      for (int x = std::max(low.x, 0); x <= std::min(high.x, grid.width - 1); ++x) {
        const Eigen::Vector2d point = grid.center_of({x, y});
        if ((point - disc.center).norm() > disc.radius) continue;
        const bool under_robot =
            map_in_robot && footprint.depth(*map_in_robot * point) > -kUnderRobot;
        if (!under_robot) cells.push_back(grid.index({x, y}));
      }
    }
  };
  for (const AnimalTracks::Animal& animal : tracks_.animals()) {
    if (!tracks_.is_known(animal, now)) continue;
    const double age = to_seconds(now - animal.stamp);
    const double way = animal.velocity_in_map.norm() * horizon_;
    const int steps = std::max(1, static_cast<int>(std::ceil(way / grid.resolution)));
    for (int step = 0; step <= steps; ++step) {
      add(tracks_.predicted(animal, age + horizon_ * step / steps));
    }
  }
}

}  // namespace coop::global_planner
