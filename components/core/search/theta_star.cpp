#include "core/search/theta_star.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/search/line_cost.hpp"

namespace coop {
namespace {

constexpr double kRounding = 1e-12;

double distance(Cell a, Cell b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

Result<GridPath, SearchFailure> ThetaStar::plan(const TraversalGrid& grid, Cell start, Cell goal) {
  if (const auto failure = check_ends(grid, start, goal)) return fail(*failure);
  prepare(grid);
  if (!search(grid, start, goal)) return fail(SearchFailure::kNoPath);
  return path(grid, start, goal);
}

void ThetaStar::prepare(const TraversalGrid& grid) {
  ++query_;
  if (nodes_.size() != grid.padded_size() || query_ == 0) {
    nodes_.assign(grid.padded_size(), Node{});
    query_ = 1;
  }
  open_.clear();
}

bool ThetaStar::search(const TraversalGrid& grid, Cell start, Cell goal) {
  const std::uint32_t first = grid.padded_index(start);
  const std::uint32_t last = grid.padded_index(goal);
  reach(first, 0.0, first, distance(start, goal));
  const auto later = [](const Entry& a, const Entry& b) {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.cost < b.cost;
  };
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), later);
    const Entry entry = open_.back();
    open_.pop_back();
    if (entry.cost > nodes_[entry.index].cost) continue;  // found a cheaper way since
    if (entry.index == last) return true;
    const std::size_t before = open_.size();
    expand(grid, entry.index, goal);
    for (std::size_t end = before + 1; end <= open_.size(); ++end) {
      std::push_heap(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(end), later);
    }
  }
  return false;
}

void ThetaStar::expand(const TraversalGrid& grid, std::uint32_t index, Cell goal) {
  const Cell here = grid.cell_at(index);
  const double factor = grid.factor(index);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Cell next{here.x + dx, here.y + dy};
      // For a straight step these are the next cell and the present one.
      if ((dx == 0 && dy == 0) || !grid.passable(next) || !grid.passable({next.x, here.y}) ||
          !grid.passable({here.x, next.y})) {
        continue;
      }
      const double length = dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0;
      const double step = 0.5 * length * (factor + grid.factor(grid.padded_index(next)));
      improve(grid, index, next, step, goal);
    }
  }
}

void ThetaStar::improve(const TraversalGrid& grid, std::uint32_t from, Cell next, double step,
                        Cell goal) {
  const std::uint32_t index = grid.padded_index(next);
  const Node& known = nodes_[index];
  const double known_cost =
      known.query == query_ ? known.cost : std::numeric_limits<double>::infinity();
  const double over_here = nodes_[from].cost + step;
  // Of two ways that differ by no more than rounding the one with fewer turns.
  const double limit = std::min(known_cost, over_here * (1.0 + kRounding));
  const std::uint32_t before = nodes_[from].parent;
  const double so_far = nodes_[before].cost;
  const Cell turn = grid.cell_at(before);
  const double to_goal = distance(next, goal);
  // No line costs less than its length, so most need not be looked along.
  if (so_far + distance(turn, next) <= limit) {
    const double straight = so_far + line_cost(grid, turn, next, limit - so_far);
    if (straight <= limit && straight < known_cost) return reach(index, straight, before, to_goal);
  }
  if (over_here < known_cost) reach(index, over_here, from, to_goal);
}

void ThetaStar::reach(std::uint32_t index, double cost, std::uint32_t parent, double to_goal) {
  nodes_[index] = {cost, parent, query_};
  open_.push_back({cost + to_goal, cost, index});
}

GridPath ThetaStar::path(const TraversalGrid& grid, Cell start, Cell goal) const {
  const std::uint32_t first = grid.padded_index(start);
  std::uint32_t index = grid.padded_index(goal);
  GridPath path;
  path.cells.push_back(goal);
  while (index != first) {
    const std::uint32_t parent = nodes_[index].parent;
    const Cell turn = grid.cell_at(parent);
    path.cost += line_cost(grid, turn, path.cells.back());
    path.cells.push_back(turn);
    index = parent;
  }
  std::reverse(path.cells.begin(), path.cells.end());
  path.cost *= grid.geometry().resolution;
  return path;
}

}  // namespace coop
