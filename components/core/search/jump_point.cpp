#include "core/search/jump_point.hpp"

#include <algorithm>
#include <cstdlib>
#include <numbers>

namespace coop {
namespace {

constexpr double kSqrt2 = std::numbers::sqrt2;

int sign(int value) {
  return (value > 0) - (value < 0);
}

}  // namespace

Result<GridPath, SearchFailure> JumpPoint::plan(const TraversalGrid& grid, Cell start, Cell goal) {
  if (const auto failure = check_ends(grid, start, goal)) return fail(*failure);
  if (!prepare(grid)) return fail(SearchFailure::kCostsDiffer);
  if (!search({start.x + 1, start.y + 1}, {goal.x + 1, goal.y + 1})) {
    return fail(SearchFailure::kNoPath);
  }
  return path(grid, goal);
}

bool JumpPoint::prepare(const TraversalGrid& grid) {
  for (const Node& node : nodes_) number_[node.cell] = 0;
  nodes_.clear();
  open_.clear();
  expansions_ = 0;
  if (revision_ != grid.revision()) {
    revision_ = grid.revision();
    stride_ = grid.stride();
    costs_differ_ = !bits_.update(grid);
    number_.assign(grid.padded_size(), 0);
  }
  return !costs_differ_;
}

double JumpPoint::estimate(Cell at) const {
  const int dx = std::abs(at.x - goal_.x);
  const int dy = std::abs(at.y - goal_.y);
  return std::max(dx, dy) + (kSqrt2 - 1.0) * std::min(dx, dy);
}

bool JumpPoint::search(Cell start, Cell goal) {
  goal_ = goal;
  goal_index_ = index_of(goal);
  const Origin origin{start, 0, 0.0};
  nodes_.push_back({0.0, index_of(start), 0, 0, 0, true});
  number_[index_of(start)] = 1;
  if (start == goal) return true;
  expand_all(origin);
  // Cheapest estimate first; of equal ones the one farther along.
  const auto later = [](const Entry& a, const Entry& b) {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.cost < b.cost;
  };
  std::make_heap(open_.begin(), open_.end(), later);
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), later);
    const Entry entry = open_.back();
    open_.pop_back();
    if (nodes_[entry.node].closed) continue;
    nodes_[entry.node].closed = true;
    const Node node = nodes_[entry.node];  // the array may grow
    if (node.cell == goal_index_) return true;
    const auto cell = static_cast<int>(node.cell);
    const std::size_t before = open_.size();
    expand({{cell % stride_, cell / stride_}, entry.node, node.cost}, node.dx, node.dy);
    for (std::size_t end = before + 1; end <= open_.size(); ++end) {
      std::push_heap(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(end), later);
    }
  }
  return false;
}

void JumpPoint::expand_all(const Origin& from) {
  for (const int d : {-1, 1}) {
    jump_straight(from, from.at, 0.0, d, 0);
    jump_straight(from, from.at, 0.0, 0, d);
    jump_diagonal(from, d, 1);
    jump_diagonal(from, d, -1);
  }
}

/// On, and to each side on which the cell behind is blocked and the cell beside is not.
void JumpPoint::expand(const Origin& from, int dx, int dy) {
  ++expansions_;
  jump_straight(from, from.at, from.cost, dx, dy);
  for (const int side : {-1, 1}) {
    const int sx = dy * side;
    const int sy = dx * side;
    const bool forced = !passable(from.at.x - dx + sx, from.at.y - dy + sy) &&
                        passable(from.at.x + sx, from.at.y + sy);
    if (!forced) continue;
    jump_straight(from, from.at, from.cost, sx, sy);
    jump_diagonal(from, dx + sx, dy + sy);
  }
}

void JumpPoint::jump_straight(const Origin& from, Cell at, double cost, int dx, int dy) {
  const bool along_row = dy == 0;
  const search::PassableBits::Lines& lines = along_row ? bits_.rows() : bits_.columns();
  const int line = along_row ? at.y : at.x;
  const int place = along_row ? at.x : at.y;
  const int forward = dx + dy;
  const auto run = forward > 0 ? lines.run_up(line, place) : lines.run_down(line, place);
  const int goal_line = along_row ? goal_.y : goal_.x;
  const int goal_place = along_row ? goal_.x : goal_.y;
  const int length = (run.end - place) * forward;
  if (line == goal_line) {
    const int to_goal = (goal_place - place) * forward;
    if (to_goal > 0 && to_goal <= length) return reach(from, goal_, cost + to_goal, 0, 0);
  }
  if (run.blocked) return;
  reach(from, {at.x + dx * length, at.y + dy * length}, cost + length, dx, dy);
}

void JumpPoint::jump_diagonal(const Origin& from, int dx, int dy) {
  Cell at = from.at;
  for (int steps = 1;; ++steps) {
    const Cell next{at.x + dx, at.y + dy};
    if (!passable(next.x, at.y) || !passable(at.x, next.y) || !passable(next.x, next.y)) return;
    at = next;
    const double cost = from.cost + steps * kSqrt2;
    if (at == goal_) return reach(from, goal_, cost, 0, 0);
    jump_straight(from, at, cost, dx, 0);
    jump_straight(from, at, cost, 0, dy);
  }
}

void JumpPoint::reach(const Origin& from, Cell at, double cost, int dx, int dy) {
  const std::uint32_t cell = index_of(at);
  std::uint32_t& number = number_[cell];
  if (number == 0) {
    nodes_.emplace_back();
    number = static_cast<std::uint32_t>(nodes_.size());
  } else if (nodes_[number - 1].closed || nodes_[number - 1].cost <= cost) {
    return;
  }
  nodes_[number - 1] = {
      cost, cell, from.node, static_cast<std::int8_t>(dx), static_cast<std::int8_t>(dy), false};
  open_.push_back({cost + estimate(at), cost, number - 1});
}

/// Between two points of the search the path runs diagonally first, then straight.
GridPath JumpPoint::path(const TraversalGrid& grid, Cell goal) const {
  GridPath path;
  path.cells.push_back(goal);
  std::uint32_t node = number_[grid.padded_index(goal)] - 1;
  while (node != 0) {  // the start's
    node = nodes_[node].parent;
    const Cell to = grid.cell_at(nodes_[node].cell);
    Cell here = path.cells.back();
    const int straight = std::abs(std::abs(here.x - to.x) - std::abs(here.y - to.y));
    const bool along_row = std::abs(here.x - to.x) > std::abs(here.y - to.y);
    for (int step = 0; !(here == to); ++step) {
      const bool diagonal = step >= straight;
      here.x += along_row || diagonal ? sign(to.x - here.x) : 0;
      here.y += !along_row || diagonal ? sign(to.y - here.y) : 0;
      path.cells.push_back(here);
    }
  }
  std::reverse(path.cells.begin(), path.cells.end());
  path.cost = cost_of(grid, path.cells);
  return path;
}

}  // namespace coop
