#include "global_planner/swarm/ant_colony.hpp"

#include <algorithm>
#include <cmath>

namespace coop::global_planner::swarm {

void AntColonyConfig::describe(config::Fields& fields) {
  fields.integer("ants", ants, {.min = 1, .max = 10000});
  fields.integer("iterations", iterations, {.min = 1, .max = 100000});
  fields.number("pheromone", pheromone,
                {.help = "on every edge at first", .min = 1e-6, .max = 1e6});
  fields.number("evaporation", evaporation,
                {.help = "share lost an iteration", .min = 0, .max = 1});
  fields.number("alpha", alpha, {.help = "exponent of pheromone", .min = 0, .max = 10});
  fields.number("beta", beta, {.help = "exponent of visibility", .min = 0, .max = 20});
  fields.number("patience", patience,
                {.help = "steps of an ant, times width + height", .min = 1, .max = 1000});
}

void AntColony::prepare(const TraversalGrid& grid, Cell goal) {
  offsets_ = neighbour_offsets(grid);
  visibility_.assign(4 * grid.padded_size(), 0.0F);
  pheromone_.assign(4 * grid.padded_size(), static_cast<float>(config_.pheromone));
  weight_.resize(4 * grid.padded_size());
  deposit_.assign(4 * grid.padded_size(), 0.0F);
  visited_.assign(grid.padded_size(), 0);
  ant_ = 0;
  const auto away = static_cast<float>(std::pow(1.0 / 3.0, config_.beta));
  const GridGeometry& geometry = grid.geometry();
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const std::uint32_t here = grid.padded_index({x, y});
      const std::array<bool, 4> nearer{x<goal.x, y<goal.y, x> goal.x, y> goal.y};
      for (std::size_t i = 0; i < offsets_.size(); ++i) {
        if (grid.factor(here + offsets_[i]) >= TraversalGrid::kBlocked) continue;
        visibility_[4 * here + i] = nearer[i] ? 1.0F : away;
      }
    }
  }
}

void AntColony::weigh() {
  if (config_.alpha == 1.0) {
    for (std::size_t i = 0; i < weight_.size(); ++i) weight_[i] = pheromone_[i] * visibility_[i];
    return;
  }
  const auto alpha = static_cast<float>(config_.alpha);
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    weight_[i] = visibility_[i] > 0.0F ? std::pow(pheromone_[i], alpha) * visibility_[i] : 0.0F;
  }
}

bool AntColony::walk(std::uint32_t start, std::uint32_t goal, std::size_t limit) {
  ++ant_;
  track_.assign(1, start);
  visited_[start] = ant_;
  std::uint32_t here = start;
  while (here != goal && track_.size() < limit) {
    std::array<float, 4> sums{};
    float sum = 0.0F;
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      if (visited_[here + offsets_[i]] != ant_) sum += weight_[4 * here + i];
      sums[i] = sum;
    }
    if (!(sum > 0.0F)) return false;
    // Below the sum whatever the rounding, so that an edge of no weight is never drawn.
    const float drawn = static_cast<float>(random_() >> 40) * 0x1.0p-24F * sum;
    std::size_t edge = 0;
    while (edge < 3 && sums[edge] <= drawn) ++edge;
    here += offsets_[edge];
    visited_[here] = ant_;
    track_.push_back(here);
  }
  return here == goal;
}

void AntColony::leave_pheromone() {
  const float amount = static_cast<float>(config_.pheromone) / static_cast<float>(track_.size());
  for (std::size_t i = 1; i < track_.size(); ++i) {
    const std::uint32_t step = track_[i] - track_[i - 1];
    std::size_t edge = 0;
    while (offsets_[edge] != step) ++edge;
    deposit_[4 * track_[i - 1] + edge] += amount;
  }
}

Result<GridPath, SearchFailure> AntColony::plan(const TraversalGrid& grid, Cell start, Cell goal) {
  if (const auto failure = check_ends(grid, start, goal)) return fail(*failure);
  prepare(grid, goal);
  best_.clear();
  const auto limit =
      static_cast<std::size_t>(config_.patience * (grid.geometry().width + grid.geometry().height));
  const std::uint32_t from = grid.padded_index(start);
  const std::uint32_t to = grid.padded_index(goal);
  // Far below anything that matters, far above the numbers that make a processor slow.
  const auto least = static_cast<float>(1e-12 * config_.pheromone);
  const auto kept = static_cast<float>(1.0 - config_.evaporation);
  for (int t = 0; t < config_.iterations; ++t) {
    weigh();
    for (int i = 0; i < config_.ants; ++i) {
      if (!walk(from, to, limit)) continue;
      leave_pheromone();
      if (best_.empty() || track_.size() < best_.size()) best_ = track_;
    }
    for (std::size_t i = 0; i < pheromone_.size(); ++i) {
      pheromone_[i] = std::max(pheromone_[i] * kept, least) + deposit_[i];
      deposit_[i] = 0.0F;
    }
  }
  if (best_.empty()) return fail(SearchFailure::kNoPath);
  return path_of(grid, best_);
}

}  // namespace coop::global_planner::swarm
