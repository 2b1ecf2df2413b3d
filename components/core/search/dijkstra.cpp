#include "core/search/dijkstra.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace coop {
namespace {

using search::kDiagonal;
using search::kInfinity;

}  // namespace

Result<GridPath, SearchFailure> Dijkstra::plan(const TraversalGrid& grid, Cell start, Cell goal) {
  if (const auto failure = check_ends(grid, start, goal)) return fail(*failure);
  flood_past(grid, goal, start, 0.0);
  if (!std::isfinite(cost_to_goal(start))) return fail(SearchFailure::kNoPath);
  return path_from(grid, start);
}

void Dijkstra::flood(const TraversalGrid& grid, Cell goal, double limit) {
  run(grid, goal, std::nullopt, 0.0, limit / grid.geometry().resolution);
}

void Dijkstra::flood_past(const TraversalGrid& grid, Cell goal, Cell start, double slack) {
  run(grid, goal, start, slack / grid.geometry().resolution,
      std::numeric_limits<double>::infinity());
}

void Dijkstra::prepare(const TraversalGrid& grid) {
  geometry_ = grid.geometry();
  tiles_.update(grid);
  cost_.assign(tiles_.size(), kInfinity);
  const float longest_step = kDiagonal * grid.largest_factor();
  const std::uint32_t count = std::bit_ceil(static_cast<std::uint32_t>(longest_step) + 3);
  if (buckets_.size() < count) buckets_.resize(count);
  for (auto& bucket : buckets_) bucket.clear();
  bucket_mask_ = static_cast<std::uint32_t>(buckets_.size()) - 1;
  waiting_ = 0;
}

void Dijkstra::run(const TraversalGrid& grid, Cell goal, std::optional<Cell> start, double slack,
                   double limit) {
  prepare(grid);
  const std::uint32_t source = tiles_.index(goal);
  cost_[source] = 0.0F;
  buckets_[0].push_back(source);
  waiting_ = 1;
  for (current_ = 0; waiting_ > 0 && current_ <= limit; ++current_) {
    empty_bucket(grid.factors());
    if (start && cost_at(*start) < kInfinity) limit = std::min(limit, cost_at(*start) + slack);
  }
}

// What the loop needs stands in locals, which no store into an array can change.
void Dijkstra::empty_bucket(const std::array<float, 256>& factors) {
  std::vector<std::uint32_t>& bucket = buckets_[current_ & bucket_mask_];
  std::vector<std::uint32_t>* const buckets = buckets_.data();
  const std::uint32_t mask = bucket_mask_;
  float* const costs = cost_.data();
  const Cost* const cells = tiles_.cells();
  std::size_t pushed = 0;
  // No step ends in the bucket it starts from, so the bucket does not grow while it is emptied.
  for (const std::uint32_t index : bucket) {
    const float here = costs[index];
    // Where the cost has fallen since, the cell was in a lower bucket and is done.
    if (static_cast<std::uint32_t>(here) != current_) continue;
    const float factor_here = factors[cells[index]];
    const auto factor_at = [&](std::uint32_t at) { return factors[cells[at]]; };
    const auto relax = [&](std::uint32_t neighbour, float factor, float half_length) {
      const float cost = here + half_length * (factor_here + factor);
      const float old = costs[neighbour];
      // An infinite factor makes the cost infinite, which never is below the old one.
      if (cost >= old) return;
      costs[neighbour] = cost;
      const auto slot = static_cast<std::uint32_t>(cost);
      // A cell that falls within its bucket waits there already.
      if (old < kInfinity && static_cast<std::uint32_t>(old) == slot) return;
      buckets[slot & mask].push_back(neighbour);
      ++pushed;
    };
    const search::Tiles::Around to = tiles_.around(index);
    const float east = factor_at(index + to.east);
    const float west = factor_at(index + to.west);
    relax(index + to.east, east, 0.5F);
    relax(index + to.west, west, 0.5F);
    const auto relax_row = [&](std::uint32_t middle) {
      const float factor = factor_at(middle);
      if (factor == kInfinity) return;  // nor may a diagonal step pass by it
      relax(middle, factor, 0.5F);
      const std::uint32_t right = middle + to.east;
      const std::uint32_t left = middle + to.west;
      if (east < kInfinity) relax(right, factor_at(right), 0.5F * kDiagonal);
      if (west < kInfinity) relax(left, factor_at(left), 0.5F * kDiagonal);
    };
    relax_row(index + to.north);
    relax_row(index + to.south);
  }
  waiting_ += pushed;
  waiting_ -= bucket.size();
  bucket.clear();
}

double Dijkstra::cost_to_goal(Cell cell) const {
  if (!geometry_.contains(cell)) return std::numeric_limits<double>::infinity();
  return static_cast<double>(cost_at(cell)) * geometry_.resolution;
}

GridPath Dijkstra::path_from(const TraversalGrid& grid, Cell start) const {
  struct Step {
    int dx, dy;
    double length;
  };
  static constexpr std::array<Step, 8> kSteps{{{1, 0, 1.0},
                                               {0, 1, 1.0},
                                               {-1, 0, 1.0},
                                               {0, -1, 1.0},
                                               {1, 1, std::numbers::sqrt2},
                                               {-1, 1, std::numbers::sqrt2},
                                               {-1, -1, std::numbers::sqrt2},
                                               {1, -1, std::numbers::sqrt2}}};
  GridPath path;
  path.cells.push_back(start);
  Cell here = start;
  while (cost_at(here) > 0.0F) {
    const float factor_here = grid.factor(grid.padded_index(here));
    const Step* best = nullptr;
    double best_cost = std::numeric_limits<double>::infinity();
    double best_step = 0.0;
    for (const Step& step : kSteps) {
      const Cell next{here.x + step.dx, here.y + step.dy};
      if (step.dx != 0 && step.dy != 0 &&
          !(grid.passable({here.x + step.dx, here.y}) && grid.passable({here.x, here.y + step.dy})))
        continue;
      const std::uint32_t index = grid.padded_index(next);
      // The border is no part of the grid: no wave comes there.
      const float cost = cost_at(next);
      if (!(cost < cost_at(here))) continue;
      const double step_cost = step.length * 0.5 * (factor_here + grid.factor(index));
      if (cost + step_cost >= best_cost) continue;
      best_cost = cost + step_cost;
      best_step = step_cost;
      best = &step;
    }
    if (best == nullptr) break;  // unreachable: the wave came to `here` over a cheaper neighbour
    here = {here.x + best->dx, here.y + best->dy};
    path.cells.push_back(here);
    path.cost += best_step;
  }
  path.cost *= geometry_.resolution;
  return path;
}

}  // namespace coop
