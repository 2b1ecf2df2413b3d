#include "amcl/likelihood_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/costmap/distance_transform.hpp"

namespace coop::amcl {
namespace {

/// The occupied cells that a beam can end on. One is hidden where an occupied cell beside it is
/// nearer to free space by (almost) a whole cell: the inside of thick walls and boxes must not
/// count as a hit.
OccupancyGrid surfaces(const OccupancyGrid& map, int occupied_percent) {
  const GridGeometry& geometry = map.geometry;
  std::vector<std::uint8_t> is_free(geometry.size());
  for (std::size_t i = 0; i < is_free.size(); ++i) {
    is_free[i] = map.cells[i] >= 0 && map.cells[i] < occupied_percent ? 1 : 0;
  }
  Grid<std::int32_t> squared_to_free(geometry, 0);
  DistanceTransform().run(is_free, geometry.width, geometry.height, squared_to_free.cells);

  OccupancyGrid result(geometry, kFree);
  const auto nearest_to_free = [&](Cell cell) {
    std::int32_t nearest = squared_to_free[cell];
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell next{cell.x + dx, cell.y + dy};
        if (map.at_or(next, kUnknown) < occupied_percent) continue;
        nearest = std::min(nearest, squared_to_free[next]);
      }
    }
    return std::sqrt(static_cast<double>(nearest));
  };
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (map.cells[i] < occupied_percent) continue;
    const double own = std::sqrt(static_cast<double>(squared_to_free.cells[i]));
    if (own - nearest_to_free(geometry.cell_at(i)) < 0.9) result.cells[i] = kOccupied;
  }
  return result;
}

}  // namespace

void LikelihoodFieldConfig::describe(config::Fields& fields) {
  fields.number(
      "hit_stddev", hit_stddev,
      {.unit = "m", .help = "spread of a beam's end about the surface", .min = 0.005, .max = 2});
  fields.number("hit_weight", hit_weight,
                {.help = "share of beams that hit what the map shows", .min = 0.01, .max = 1});
  fields.number("random_weight", random_weight,
                {.help = "share of beams that end anywhere", .min = 0.001, .max = 1});
  fields.number("random_range", random_range,
                {.unit = "m",
                 .help = "length over which a random beam's end is uniform",
                 .min = 1,
                 .max = 200});
  fields.integer("occupied_percent", occupied_percent,
                 {.unit = "%", .help = "a cell is an obstacle from here on", .min = 1, .max = 100});
}

LikelihoodField::LikelihoodField(const LikelihoodFieldConfig& config, const OccupancyGrid& map)
    : geometry_(map.geometry), stride_(map.geometry.width + 2) {
  const double peak = 1.0 / (config.hit_stddev * std::sqrt(2.0 * std::numbers::pi));
  const double random_density = config.random_weight / config.random_range;
  const double perfect = config.hit_weight * peak + random_density;
  const auto unknown =
      static_cast<float>(std::log(std::min(1.0, 1.0 / config.random_range / perfect)));

  table_.assign(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(geometry_.height + 2),
                unknown);
  const Grid<float> distances =
      distance_to_occupied(surfaces(map, config.occupied_percent), 6.0 * config.hit_stddev);
  for (int y = 0; y < geometry_.height; ++y) {
    for (int x = 0; x < geometry_.width; ++x) {
      const double sigmas = static_cast<double>(distances[{x, y}]) / config.hit_stddev;
      const double density =
          config.hit_weight * peak * std::exp(-0.5 * sigmas * sigmas) + random_density;
      const auto known = static_cast<float>(std::log(density / perfect));
      float& value = table_[static_cast<std::size_t>((y + 1) * stride_ + x + 1)];
      const bool hidden = map[{x, y}] == kUnknown || map[{x, y}] >= config.occupied_percent;
      value = hidden ? std::max(known, unknown) : known;
    }
  }
}

float LikelihoodField::log_likelihood(const Eigen::Vector2d& point) const {
  const Cell cell = geometry_.cell_of(point);
  const int x = std::clamp(cell.x + 1, 0, stride_ - 1);
  const int y = std::clamp(cell.y + 1, 0, geometry_.height + 1);
  return table_[static_cast<std::size_t>(y * stride_ + x)];
}

void LikelihoodField::score(const ParticleSet& particles, const BeamEnds& ends,
                            std::vector<float>& scores) {
  const auto per_metre = static_cast<float>(1.0 / geometry_.resolution);
  const std::size_t beams = ends.size();
  ends_in_cells_.x.resize(beams);
  ends_in_cells_.y.resize(beams);
  for (std::size_t b = 0; b < beams; ++b) {
    ends_in_cells_.x[b] = ends.x[b] * per_metre;
    ends_in_cells_.y[b] = ends.y[b] * per_metre;
  }
  const float* bx = ends_in_cells_.x.data();
  const float* by = ends_in_cells_.y.data();
  const float* table = table_.data();
  const auto stride = static_cast<std::size_t>(stride_);
  const auto max_x = static_cast<float>(stride_ - 1);
  const auto max_y = static_cast<float>(geometry_.height + 1);
  const auto origin_x = static_cast<float>(geometry_.origin.x());
  const auto origin_y = static_cast<float>(geometry_.origin.y());
  const float share = 1.0F / static_cast<float>(beams);

  scores.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    // The border of the table takes whatever ends outside the map: one clamp, no branch.
    const float px = (particles.x[i] - origin_x) * per_metre + 1.0F;
    const float py = (particles.y[i] - origin_y) * per_metre + 1.0F;
    const float c = std::cos(particles.yaw[i]);
    const float s = std::sin(particles.yaw[i]);
    float sum = 0.0F;
    for (std::size_t b = 0; b < beams; ++b) {
      const float x = px + c * bx[b] - s * by[b];
      const float y = py + s * bx[b] + c * by[b];
      const auto column = static_cast<std::size_t>(std::min(max_x, std::max(0.0F, x)));
      const auto row = static_cast<std::size_t>(std::min(max_y, std::max(0.0F, y)));
      sum += table[row * stride + column];
    }
    scores[i] = sum * share;
  }
}

}  // namespace coop::amcl
