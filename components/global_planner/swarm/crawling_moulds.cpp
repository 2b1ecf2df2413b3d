#include <array>
#include <cmath>
#include <limits>

#include "global_planner/swarm/casma.hpp"

namespace coop::global_planner::swarm {

void CrawlingMoulds::reset(const TraversalGrid& grid, std::uint32_t start, Cell goal) {
  const auto count = static_cast<std::size_t>(config_.population);
  const Cell cell = grid.cell_at(start);
  trails_.resize(count);
  for (Track& trail : trails_) trail.assign(1, start);
  at_.assign(count, cell);
  best_place_ = cell;
  best_fitness_ = manhattan(cell, goal);
  fitness_.assign(count, best_fitness_);
  arrived_.assign(count, cell == goal ? 1 : 0);
  pheromone_.reset(grid.padded_size());
  best_.clear();
}

const Track& CrawlingMoulds::search(const TraversalGrid& grid, Cell start, Cell goal,
                                    RandomStream& random) {
  const std::uint32_t from = grid.padded_index(start);
  const std::uint32_t to = grid.padded_index(goal);
  reset(grid, from, goal);
  for (int t = 1; t <= config_.iterations; ++t) {
    ranking_.update(fitness_);
    before_ = at_;
    for (std::size_t i = 0; i < at_.size(); ++i) {
      if (arrived_[i] != 0) continue;  // it has its food
      crawl(grid, i, aim(grid, i, t, random), random);
      pheromone_.visit(trails_[i].back());
      fitness_[i] = manhattan(at_[i], goal);
      if (at_[i] == goal) arrived_[i] = 1;
      if (fitness_[i] >= best_fitness_) continue;
      best_fitness_ = fitness_[i];
      best_place_ = at_[i];
    }
  }
  for (std::size_t i = 0; i < at_.size(); ++i) {
    if (arrived_[i] != 0) offer(trails_[i], grid.padded_size());
  }
  if (best_.empty()) return best_;
  follow_pheromone(grid, from, to);
  offer(candidate_, grid.padded_size());
  return best_;
}

CrawlingMoulds::Aim CrawlingMoulds::aim(const TraversalGrid& grid, std::size_t mould, int iteration,
                                        RandomStream& random) {
  const bool printed = config_.method == "printed";
  const double fading = slime::fading(iteration, config_.iterations);
  const std::uint32_t cell = trails_[mould].back();
  const double c_omega =
      printed ? pheromone_.printed_weight(cell, fading) : pheromone_.weight(cell, fading);
  const Cell at = at_[mould];
  const double r = random.uniform();
  if ((printed ? c_omega : r) < config_.z) {
    // lb is cell (0, 0), ub the last one.
    const double share_x = printed ? c_omega : c_omega * random.uniform();
    const double share_y = printed ? c_omega : c_omega * random.uniform();
    return {share_x * (grid.geometry().width - 1), share_y * (grid.geometry().height - 1)};
  }
  if (r < slime::chance_of_approach(fitness_[mould], best_fitness_)) {
    const double a = slime::approach_range(iteration, config_.iterations);
    const Cell one = before_[random.below(before_.size())];
    const Cell other = before_[random.below(before_.size())];
    const double w = slime::weight(ranking_.in_better_half(mould), random.uniform(),
                                   fitness_[mould], ranking_.best(), ranking_.worst());
    return {best_place_.x + random.uniform(-a, a) * (w * one.x - other.x),
            best_place_.y + random.uniform(-a, a) * (w * one.y - other.y)};
  }
  const double b = slime::contraction_range(iteration, config_.iterations);
  return {random.uniform(-b, b) * at.x, random.uniform(-b, b) * at.y};
}

void CrawlingMoulds::crawl(const TraversalGrid& grid, std::size_t mould, const Aim& aim,
                           RandomStream& random) {
  static constexpr std::array<Cell, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  const auto offsets = neighbour_offsets(grid);
  const std::uint32_t here = trails_[mould].back();
  const Cell at = at_[mould];
  const std::size_t first = random() >> 62;
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t chosen = offsets.size();
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    const std::size_t i = (first + k) & 3U;
    if (grid.factor(here + offsets[i]) >= TraversalGrid::kBlocked) continue;
    const double distance =
        std::abs(at.x + kSteps[i].x - aim.x) + std::abs(at.y + kSteps[i].y - aim.y);
    if (distance >= nearest) continue;
    nearest = distance;
    chosen = i;
  }
  if (chosen == offsets.size()) return;  // shut in
  trails_[mould].push_back(here + offsets[chosen]);
  at_[mould] = {at.x + kSteps[chosen].x, at.y + kSteps[chosen].y};
}

void CrawlingMoulds::follow_pheromone(const TraversalGrid& grid, std::uint32_t start,
                                      std::uint32_t goal) {
  const auto offsets = neighbour_offsets(grid);
  visited_.assign(grid.padded_size(), 0);
  candidate_.assign(1, start);
  visited_[start] = 1;
  while (candidate_.back() != goal) {
    double strongest = CellPheromone::kInitial;
    std::uint32_t next = candidate_.back();
    for (const std::uint32_t offset : offsets) {
      const std::uint32_t there = candidate_.back() + offset;
      if (visited_[there] != 0 || !(pheromone_.at(there) > strongest)) continue;
      strongest = pheromone_.at(there);
      next = there;
    }
    if (next == candidate_.back()) {
      // A dead end: back. The goal was visited, so there is a way to it.
      candidate_.pop_back();
      continue;
    }
    visited_[next] = 1;
    candidate_.push_back(next);
  }
}

void CrawlingMoulds::offer(Track& track, std::size_t cells) {
  eraser_.erase(track, cells);
  if (best_.empty() || track.size() < best_.size()) best_ = track;
}

}  // namespace coop::global_planner::swarm
