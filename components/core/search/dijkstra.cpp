#include "core/search/dijkstra.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace coop {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kDiagonal = std::numbers::sqrt2_v<float>;
constexpr std::uint32_t kNowhere = ~std::uint32_t{0};

}  // namespace

Result<GridPath, SearchFailure> Dijkstra::plan(const TraversalGrid& grid, Cell start, Cell goal) {
  if (!grid.passable(goal)) return fail(SearchFailure::kGoalBlocked);
  if (!grid.passable(start)) return fail(SearchFailure::kStartBlocked);
  flood_past(grid, goal, start, 0.0);
  if (!std::isfinite(cost_to_goal(start))) return fail(SearchFailure::kNoPath);
  return path_from(grid, start);
}

void Dijkstra::flood(const TraversalGrid& grid, Cell goal, double limit) {
  run(grid, goal, kNowhere, 0.0, limit / grid.geometry().resolution);
}

void Dijkstra::flood_past(const TraversalGrid& grid, Cell goal, Cell start, double slack) {
  run(grid, goal, grid.padded_index(start), slack / grid.geometry().resolution,
      std::numeric_limits<double>::infinity());
}

void Dijkstra::prepare(const TraversalGrid& grid) {
  geometry_ = grid.geometry();
  stride_ = grid.stride();
  cost_.assign(grid.padded_size(), kInfinity);
  const float longest_step = kDiagonal * grid.largest_factor();
  const std::uint32_t count = std::bit_ceil(static_cast<std::uint32_t>(longest_step) + 3);
  if (buckets_.size() < count) buckets_.resize(count);
  for (auto& bucket : buckets_) bucket.clear();
  bucket_mask_ = static_cast<std::uint32_t>(buckets_.size()) - 1;
  waiting_ = 0;
}

void Dijkstra::run(const TraversalGrid& grid, Cell goal, std::uint32_t start, double slack,
                   double limit) {
  prepare(grid);
  const std::uint32_t source = grid.padded_index(goal);
  cost_[source] = 0.0F;
  buckets_[0].push_back(source);
  waiting_ = 1;
  for (current_ = 0; waiting_ > 0 && current_ <= limit; ++current_) {
    std::vector<std::uint32_t>& bucket = buckets_[current_ & bucket_mask_];
    // No step ends in the bucket it starts from, so the bucket does not grow while it is emptied.
    for (const std::uint32_t index : bucket) {
      // Where the cost has fallen since, the cell was in a lower bucket and is done.
      if (static_cast<std::uint32_t>(cost_[index]) == current_) expand(grid, index);
    }
    waiting_ -= bucket.size();
    bucket.clear();
    if (start != kNowhere && cost_[start] < kInfinity) {
      limit = std::min(limit, cost_[start] + slack);
    }
  }
}

void Dijkstra::expand(const TraversalGrid& grid, std::uint32_t index) {
  const Cost* cells = grid.cells().data();
  const float* factors = grid.factors().data();
  const float here = cost_[index];
  const float factor_here = factors[cells[index]];
  const auto relax = [&](std::uint32_t neighbour, float factor, float half_length) {
    const float cost = here + half_length * (factor_here + factor);
    const float old = cost_[neighbour];
    if (cost >= old) return;
    cost_[neighbour] = cost;
    const auto slot = static_cast<std::uint32_t>(cost);
    // A cell that falls within its bucket waits there already.
    if (old < kInfinity && static_cast<std::uint32_t>(old) == slot) return;
    buckets_[slot & bucket_mask_].push_back(neighbour);
    ++waiting_;
  };
  const auto up = static_cast<std::uint32_t>(stride_);
  const float east = factors[cells[index + 1]];
  const float west = factors[cells[index - 1]];
  const float north = factors[cells[index + up]];
  const float south = factors[cells[index - up]];
  // An infinite factor makes the cost infinite, which never is below the old one.
  relax(index + 1, east, 0.5F);
  relax(index - 1, west, 0.5F);
  relax(index + up, north, 0.5F);
  relax(index - up, south, 0.5F);
  const auto relax_diagonal = [&](std::uint32_t neighbour, float side_a, float side_b) {
    if (side_a + side_b < kInfinity) relax(neighbour, factors[cells[neighbour]], 0.5F * kDiagonal);
  };
  relax_diagonal(index + up + 1, north, east);
  relax_diagonal(index + up - 1, north, west);
  relax_diagonal(index - up + 1, south, east);
  relax_diagonal(index - up - 1, south, west);
}

double Dijkstra::cost_to_goal(Cell cell) const {
  if (!geometry_.contains(cell)) return std::numeric_limits<double>::infinity();
  const auto index = static_cast<std::size_t>((cell.y + 1) * stride_ + cell.x + 1);
  return static_cast<double>(cost_[index]) * geometry_.resolution;
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
  while (cost_[grid.padded_index(here)] > 0.0F) {
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
      if (!(cost_[index] < cost_[grid.padded_index(here)])) continue;
      const double step_cost = step.length * 0.5 * (factor_here + grid.factor(index));
      if (cost_[index] + step_cost >= best_cost) continue;
      best_cost = cost_[index] + step_cost;
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
