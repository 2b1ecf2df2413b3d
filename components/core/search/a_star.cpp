#include "core/search/a_star.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace coop {
namespace {

using search::kDiagonal;
using search::kInfinity;

constexpr float kSlotsPerCell = 4.0F;

/// Steps are numbered anticlockwise from east; diagonals are odd.
constexpr std::array<Cell, 8> kSteps{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
constexpr std::uint8_t kStepMask = 7;
constexpr std::uint8_t kAll = 8;       ///< the start: no step led there
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
  // A step raises cost + estimate by at most twice its own cost.
  const float widest = 2.0F * kSlotsPerCell * kDiagonal * grid.largest_factor();
  const std::uint32_t count = std::bit_ceil(static_cast<std::uint32_t>(widest) + 3);
  if (buckets_.size() < count) buckets_.resize(count);
  for (auto& bucket : buckets_) bucket.clear();
  bucket_mask_ = static_cast<std::uint32_t>(buckets_.size()) - 1;
  expansions_ = 0;
}

std::uint32_t AStar::slot_of(float cost, Cell at) const {
  return static_cast<std::uint32_t>(kSlotsPerCell * (cost + octile(at, goal_)));
}

void AStar::search(const std::array<float, 256>& factors, Cell start, Cell goal) {
  goal_ = goal;
  const std::uint32_t first = tiles_.index(start);
  const std::uint32_t last = tiles_.index(goal);
  current_ = slot_of(0.0F, start);
  cost_[first] = 0.0F;
  arrival_[first] = kAll | kWaiting;
  touched_[first / search::Tiles::kTile] = 1;
  buckets_[current_ & bucket_mask_].push_back(first);
  waiting_ = 1;
  // Once the goal is reached, only cells whose cost + estimate lies below its cost can improve it.
  for (; waiting_ > 0; ++current_) {
    std::vector<std::uint32_t>& bucket = buckets_[current_ & bucket_mask_];
    while (!bucket.empty()) {
      const std::uint32_t index = bucket.back();
      bucket.pop_back();
      --waiting_;
      if ((arrival_[index] & kWaiting) == 0) continue;  // expanded since, at a lower cost
      arrival_[index] &= static_cast<std::uint8_t>(~kWaiting);
      if (cost_[last] < kInfinity &&
          cost_[index] + octile(tiles_.cell_at(index), goal) >= cost_[last]) {
        continue;
      }
      expand(factors, index, arrival_[index]);
    }
    if (slot_of(cost_[last], goal) <= current_ && cost_[last] < kInfinity) return;
  }
}

void AStar::expand(const std::array<float, 256>& factors, std::uint32_t index,
                   std::uint32_t arrival) {
  ++expansions_;
  const Cost* cells = tiles_.cells();
  const search::Tiles::Around to = tiles_.around(index);
  const std::array<std::uint32_t, 8> at{
      index + to.east, index + to.north + to.east, index + to.north, index + to.north + to.west,
      index + to.west, index + to.south + to.west, index + to.south, index + to.south + to.east};
  const Cost own = cells[index];
  std::uint32_t different = 0;
  for (const std::uint32_t neighbour : at) different |= cells[neighbour] ^ own;
  const Cell here = tiles_.cell_at(index);
  const float cost = cost_[index];
  const float factor = factors[own];
  const auto take = [&](std::uint32_t step, float length_and_factor) {
    relax(at[step], cost + length_and_factor, {here.x + kSteps[step].x, here.y + kSteps[step].y},
          step);
  };
  if (different == 0 && arrival != kAll) {
    if ((arrival & 1U) == 0) return take(arrival, factor);
    take((arrival + 7U) & kStepMask, factor);
    take((arrival + 1U) & kStepMask, factor);
    return take(arrival, kDiagonal * factor);
  }
  std::array<float, 8> there;
  for (std::size_t step = 0; step < 8; ++step) there[step] = factors[cells[at[step]]];
  for (std::uint32_t step = 0; step < 8; step += 2) {
    if (there[step] < kInfinity) take(step, 0.5F * (factor + there[step]));
    const float side = there[(step + 2U) & kStepMask];
    if (there[step] + there[step + 1U] + side == kInfinity) continue;
    take(step + 1U, 0.5F * kDiagonal * (factor + there[step + 1U]));
  }
}

void AStar::relax(std::uint32_t neighbour, float cost, Cell at, std::uint32_t step) {
  const float old = cost_[neighbour];
  if (cost >= old) return;
  const std::uint32_t slot = std::max(current_, slot_of(cost, at));
  const bool in_place = old < kInfinity && (arrival_[neighbour] & kWaiting) != 0 &&
                        std::max(current_, slot_of(old, at)) == slot;
  cost_[neighbour] = cost;
  arrival_[neighbour] = static_cast<std::uint8_t>(step | kWaiting);
  if (in_place) return;
  touched_[neighbour / search::Tiles::kTile] = 1;
  buckets_[slot & bucket_mask_].push_back(neighbour);
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
