#include "global_planner/swarm/via_points.hpp"

#include <algorithm>

namespace coop::global_planner::swarm {

void ViaPointConfig::describe(config::Fields& fields) {
  fields.integer("via_points", via_points,
                 {.help = "corners a swarm can place freely", .min = 1, .max = 100});
}

void ViaPointObjective::set(const TraversalGrid& grid, Cell start, Cell goal) {
  grid_ = &grid;
  start_ = start;
  goal_ = goal;
  const auto points = static_cast<std::size_t>(config_.via_points);
  lower_.assign(2 * points, 0.0);
  upper_.resize(2 * points);
  for (std::size_t i = 0; i < points; ++i) {
    upper_[2 * i] = grid.geometry().width;
    upper_[2 * i + 1] = grid.geometry().height;
  }
  const auto stride = static_cast<std::size_t>(grid.stride());
  in_row_.assign(grid.padded_size(), 0);
  in_column_.assign(grid.padded_size(), 0);
  for (std::size_t i = stride; i < grid.padded_size(); ++i) {
    const bool blocked = grid.factor(static_cast<std::uint32_t>(i)) >= TraversalGrid::kBlocked;
    in_row_[i] = in_row_[i - 1] + (blocked ? 1 : 0);
    in_column_[i] = in_column_[i - stride] + (blocked ? 1 : 0);
  }
}

Cell ViaPointObjective::point(std::span<const double> place, std::size_t i) const {
  return {std::min(static_cast<int>(place[2 * i]), grid_->geometry().width - 1),
          std::min(static_cast<int>(place[2 * i + 1]), grid_->geometry().height - 1)};
}

std::int32_t ViaPointObjective::blocked_along_row(int y, int from, int to) const {
  const std::size_t first = grid_->padded_index({std::min(from, to), y});
  const std::size_t last = grid_->padded_index({std::max(from, to), y});
  return in_row_[last] - in_row_[first - 1];
}

std::int32_t ViaPointObjective::blocked_along_column(int x, int from, int to) const {
  const std::size_t first = grid_->padded_index({x, std::min(from, to)});
  const std::size_t last = grid_->padded_index({x, std::max(from, to)});
  return in_column_[last] - in_column_[first - static_cast<std::size_t>(grid_->stride())];
}

std::array<std::int32_t, 2> ViaPointObjective::blocked_on_leg(Cell from, Cell to) const {
  return {blocked_along_row(from.y, from.x, to.x) + blocked_along_column(to.x, from.y, to.y),
          blocked_along_column(from.x, from.y, to.y) + blocked_along_row(to.y, from.x, to.x)};
}

double ViaPointObjective::operator()(std::span<const double> place) {
  const auto points = static_cast<std::size_t>(config_.via_points);
  int steps = 0;
  std::int32_t blocked = 0;
  Cell here = start_;
  for (std::size_t i = 0; i <= points; ++i) {
    const Cell next = i < points ? point(place, i) : goal_;
    steps += manhattan(here, next);
    const auto [x_first, y_first] = blocked_on_leg(here, next);
    blocked += std::min(x_first, y_first);
    here = next;
  }
  return steps +
         static_cast<double>(blocked) * (grid_->geometry().width + grid_->geometry().height);
}

bool ViaPointObjective::trace(std::span<const double> place, Track& track) const {
  const auto points = static_cast<std::size_t>(config_.via_points);
  const auto up = static_cast<std::uint32_t>(grid_->stride());
  std::uint32_t here = grid_->padded_index(start_);
  std::int32_t blocked = 0;
  track.assign(1, here);
  const auto run = [&](int cells, std::uint32_t step) {
    for (int i = 0; i < std::abs(cells); ++i) {
      here += cells > 0 ? step : 0U - step;
      track.push_back(here);
    }
  };
  Cell from = start_;
  for (std::size_t i = 0; i <= points; ++i) {
    const Cell to = i < points ? point(place, i) : goal_;
    const auto [x_first, y_first] = blocked_on_leg(from, to);
    blocked += std::min(x_first, y_first);
    if (x_first <= y_first) run(to.x - from.x, 1U);
    run(to.y - from.y, up);
    if (x_first > y_first) run(to.x - from.x, 1U);
    from = to;
  }
  return blocked == 0;
}

Result<GridPath, SearchFailure> ViaPointPlanner::plan(const TraversalGrid& grid, Cell start,
                                                      Cell goal) {
  if (const auto failure = check_ends(grid, start, goal)) return fail(*failure);
  objective_.set(grid, start, goal);
  const Minimum best = optimiser_->minimise(objective_, random_);
  if (!objective_.trace(best.place, track_)) return fail(SearchFailure::kNoPath);
  eraser_.erase(track_, grid.padded_size());
  return path_of(grid, track_);
}

}  // namespace coop::global_planner::swarm
