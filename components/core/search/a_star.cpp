#include "core/search/a_star.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace coop {
namespace {

using search::kDiagonal;
using search::kInfinity;

constexpr float kSlotsPerCell = 4.0F;
constexpr int kLongestRun = 8;  ///< cells that are reached before their turn

/// Steps are numbered anticlockwise from east; diagonals are odd.
constexpr std::array<Cell, 8> kSteps{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
constexpr std::uint8_t kStepMask = 7;
constexpr std::uint8_t kAll = 8;  ///< the start: no step led there
constexpr std::uint8_t kArrivalMask = 15;
constexpr std::uint8_t kWaiting = 16;  ///< flag: the cell is in the open list

float octile(Cell from, Cell to) {
  const int dx = std::abs(from.x - to.x);
  const int dy = std::abs(from.y - to.y);
  return static_cast<float>(std::max(dx, dy)) +
         (kDiagonal - 1.0F) * static_cast<float>(std::min(dx, dy));
}

}  // namespace

Result<GridPath, SearchFailure> AStar::plan(const TraversalGrid& grid, Cell start, Cell goal) {
  if (const auto failure = check_ends(grid, start, goal)) return fail(*failure);
  prepare(grid);
  search(grid.factors(), start, goal);
  if (cost_[tiles_.index(goal)] == kInfinity) return fail(SearchFailure::kNoPath);
  return path(grid, start, goal);
}

void AStar::prepare(const TraversalGrid& grid) {
  tiles_.update(grid);
  const std::size_t tiles = tiles_.size() / search::Tiles::kTile;
  if (cost_.size() != tiles_.size()) {
    cost_.assign(tiles_.size(), kInfinity);
    arrival_.assign(tiles_.size(), 0);
    touched_.assign(tiles, 0);
  }
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    if (touched_[tile] == 0) continue;
    touched_[tile] = 0;
    std::fill_n(cost_.begin() + static_cast<std::ptrdiff_t>(tile * search::Tiles::kTile),
                search::Tiles::kTile, kInfinity);
  }
  // A step raises cost + estimate by at most twice its own cost, a run by that of its cells.
  const float farthest = (kDiagonal + static_cast<float>(kLongestRun)) * grid.largest_factor();
  const float widest = 2.0F * kSlotsPerCell * farthest;
  const std::uint32_t count = std::bit_ceil(static_cast<std::uint32_t>(widest) + 3);
  if (buckets_.size() < count) buckets_.resize(count);
  for (auto& bucket : buckets_) bucket.clear();
  bucket_mask_ = static_cast<std::uint32_t>(buckets_.size()) - 1;
  expansions_ = 0;
}

std::uint32_t AStar::slot_of(float estimate) const {
  return std::max(current_, static_cast<std::uint32_t>(kSlotsPerCell * estimate));
}

void AStar::search(const std::array<float, 256>& factors, Cell start, Cell goal) {
  goal_ = goal;
  const std::uint32_t first = tiles_.index(start);
  last_ = tiles_.index(goal);
  current_ = 0;
  current_ = slot_of(octile(start, goal));
  cost_[first] = 0.0F;
  arrival_[first] = kAll | kWaiting;
  touched_[first / search::Tiles::kTile] = 1;
  buckets_[current_ & bucket_mask_].push_back(first);
  waiting_ = 1;
  // Once the goal is reached, only cells whose cost + estimate lies below its cost can improve it.
  for (; waiting_ > 0; ++current_) {
    empty_bucket(factors);
    if (cost_[last_] < kInfinity && slot_of(cost_[last_]) == current_) return;
  }
}

void AStar::empty_bucket(const std::array<float, 256>& factors) {
  std::vector<std::uint32_t>& bucket = buckets_[current_ & bucket_mask_];
  while (!bucket.empty()) {
    const std::uint32_t index = bucket.back();
    bucket.pop_back();
    --waiting_;
    const std::uint8_t arrival = arrival_[index];
    if ((arrival & kWaiting) == 0) continue;  // expanded since, at a lower cost
    arrival_[index] = arrival & kArrivalMask;
    next_ = index;
    do {
      const std::uint32_t here = next_;
      next_ = kNowhere;
      if (cost_[last_] < kInfinity &&
          cost_[here] + octile(tiles_.cell_at(here), goal_) >= cost_[last_]) {
        continue;
      }
      expand(factors, here);
    } while (next_ != kNowhere);
  }
}

void AStar::expand(const std::array<float, 256>& factors, std::uint32_t index) {
  ++expansions_;
  const bool inside = search::Tiles::has_inner_ring(index);
  search::Tiles::Ring border_ring;
  if (!inside) border_ring = tiles_.ring(index);
  const search::Tiles::Ring& ring = inside ? search::Tiles::kInnerRing : border_ring;
  const Cost* cells = tiles_.cells();
  const float factor = factors[cells[index]];
  const float cost = cost_[index];
  const float* const costs = cost_.data();
  const auto take = [&](std::uint32_t step, float step_cost) {
    const std::uint32_t to = index + ring[step];
    if (cost + step_cost < costs[to]) reach(to, cost + step_cost, step);
  };
  const auto run = [&](std::uint32_t step, float step_cost) {
    const std::uint32_t to = index + ring[step];
    if (cost + step_cost < costs[to]) reach_along(factors[cells[to]], to, cost + step_cost, step);
  };
  const std::uint32_t arrival = arrival_[index] & kArrivalMask;
  if (arrival != kAll && (inside ? tiles_.alike_inside(index) : tiles_.alike(index, ring))) {
    if ((arrival & 1U) == 0) return run(arrival, factor);
    run((arrival + 7U) & kStepMask, factor);
    run((arrival + 1U) & kStepMask, factor);
    return take(arrival, kDiagonal * factor);
  }
  const auto factor_at = [&](std::uint32_t step) {
    return factors[cells[index + ring[step & kStepMask]]];
  };
  const auto take_straight = [&](std::uint32_t step, float there) {
    if (there < kInfinity) run(step & kStepMask, 0.5F * (factor + there));
  };
  const auto take_diagonal = [&](std::uint32_t step, float there, float side, float other_side) {
    if (there + side + other_side == kInfinity) return;
    take(step & kStepMask, 0.5F * kDiagonal * (factor + there));
  };
  if (arrival == kAll) {
    for (std::uint32_t step = 0; step < 8; step += 2) {
      take_straight(step, factor_at(step));
      take_diagonal(step + 1U, factor_at(step + 1U), factor_at(step), factor_at(step + 2U));
    }
    return;
  }
  // Back, and to the two cells beside it, the cell before leads more cheaply.
  const float right = factor_at(arrival + 7U);
  const float ahead = factor_at(arrival);
  const float left = factor_at(arrival + 1U);
  const float far_right = factor_at(arrival + 6U);
  const float far_left = factor_at(arrival + 2U);
  if ((arrival & 1U) == 0) {
    take_straight(arrival + 6U, far_right);
    take_straight(arrival + 2U, far_left);
    take_diagonal(arrival + 7U, right, far_right, ahead);
    take_diagonal(arrival + 1U, left, far_left, ahead);
    return take_straight(arrival, ahead);
  }
  take_diagonal(arrival + 6U, far_right, right, factor_at(arrival + 5U));
  take_diagonal(arrival + 2U, far_left, left, factor_at(arrival + 3U));
  take_straight(arrival + 7U, right);
  take_straight(arrival + 1U, left);
  take_diagonal(arrival, ahead, left, right);
}

void AStar::reach_along(float factor, std::uint32_t index, float cost, std::uint32_t step) {
  float* const costs = cost_.data();
  for (int length = 0; length < kLongestRun && index != last_; ++length) {
    std::uint32_t to = search::Tiles::kInnerRing[step];
    if (search::Tiles::has_inner_ring(index)) {
      if (!tiles_.alike_inside(index)) break;
    } else {
      const search::Tiles::Ring ring = tiles_.ring(index);
      if (!tiles_.alike(index, ring)) break;
      to = ring[step];
    }
    costs[index] = cost;
    arrival_[index] = static_cast<std::uint8_t>(step);
    touched_[index / search::Tiles::kTile] = 1;
    index += to;
    cost += factor;
    if (cost >= costs[index]) return;
  }
  reach(index, cost, step);
}

void AStar::reach(std::uint32_t index, float cost, std::uint32_t step) {
  const float old = cost_[index];
  const float ahead = octile(tiles_.cell_at(index), goal_);
  const std::uint32_t slot = slot_of(cost + ahead);
  const bool waits = old < kInfinity && (arrival_[index] & kWaiting) != 0;
  cost_[index] = cost;
  arrival_[index] = static_cast<std::uint8_t>(step | kWaiting);
  if (waits && slot_of(old + ahead) == slot) return;
  touched_[index / search::Tiles::kTile] = 1;
  if (slot == current_ && !waits) {
    // Expanded next; one that was to be expanded next waits in the bucket.
    arrival_[index] = static_cast<std::uint8_t>(step);
    std::swap(index, next_);
    if (index == kNowhere) return;
    arrival_[index] |= kWaiting;
  }
  buckets_[slot & bucket_mask_].push_back(index);
  ++waiting_;
}

GridPath AStar::path(const TraversalGrid& grid, Cell start, Cell goal) const {
  GridPath path;
  for (Cell here = goal;;) {
    path.cells.push_back(here);
    if (here == start) break;
    const Cell step = kSteps[arrival_[tiles_.index(here)] & kStepMask];
    here = {here.x - step.x, here.y - step.y};
  }
  std::reverse(path.cells.begin(), path.cells.end());
  path.cost = cost_of(grid, path.cells);
  return path;
}

}  // namespace coop
