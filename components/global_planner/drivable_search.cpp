#include "global_planner/drivable_search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/vehicle/ackermann.hpp"

namespace coop::global_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kCell = 0.1;  ///< m: states of one cell, heading and direction count as one
constexpr int kHeadings = 72;
/// Expanded from one sign of progress to the next.
constexpr std::size_t kProgressStates = 500;
constexpr std::array<double, 6> kApproachParts{1.0, 0.8, 0.6, 0.4, 0.2, 0.0};

Pose2 advance(const Pose2& from, const Arc& arc) {
  return vehicle::advance_along_arc(from, arc.length, arc.length * arc.curvature);
}

int direction_of(const Arc& arc) {
  return arc.length < 0.0 ? -1 : 1;
}

}  // namespace

void DrivableConfig::describe(config::Fields& fields) {
  fields.number("radius_margin", radius_margin,
                {.help = "planned turning radius over the robot's smallest", .min = 1, .max = 3});
  fields.number("step", step,
                {.unit = "m", .help = "driven from state to state", .min = 0.15, .max = 1});
  fields.section("arc_cost", arc_cost);
  fields.number(
      "approach_length", approach_length,
      {.unit = "m", .help = "straight line on which the goal is approached", .min = 0, .max = 5});
  fields.number("short_approach_cost", short_approach_cost,
                {.help = "for each metre missing of it", .min = 0, .max = 50});
  fields.number("greed", greed,
                {.help = "weight of the estimated rest of the way: larger is faster and worse",
                 .min = 1,
                 .max = 5});
  fields.number("suboptimality", suboptimality,
                {.help = "the search ends when nothing can be cheaper by more than this part",
                 .min = 0,
                 .max = 2});
  fields.integer(
      "extra_states", extra_states,
      {.help = "expanded at most once a first path is known", .min = 0, .max = 10000000});
  fields.integer("max_states", max_states,
                 {.help = "the search gives up after this many", .min = 1000, .max = 10000000});
}

DrivableSearch::DrivableSearch(const DrivableConfig& config, double min_turning_radius)
    : config_(config),
      curves_(min_turning_radius * config.radius_margin),
      turning_(min_turning_radius * config.radius_margin),
      arc_cost_(config.arc_cost, min_turning_radius * config.radius_margin) {
  for (const double part : kApproachParts) approaches_.push_back(part * config.approach_length);
  const auto states = static_cast<std::size_t>(config.max_states);
  nodes_.reserve(states);
  keys_.reserve(states);
  open_.reserve(2 * states);
  table_.resize(std::bit_ceil(2 * states));
  shots_.reserve(ReedsShepp::kMaxWords * kApproachParts.size());
}

Result<DrivablePath, DrivableFailure> DrivableSearch::plan(const World& world, const Pose2& start,
                                                           const Pose2& goal, int direction) {
  clear();
  open(world, goal, {start, 0.0F, -1, 0.0F, 0, static_cast<std::int8_t>(direction), false});
  std::size_t expanded = 0;
  std::size_t next_shot = 0;
  std::size_t last = std::numeric_limits<std::size_t>::max();
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>{});
    const auto [estimate, index] = open_.back();
    open_.pop_back();
    Node& node = nodes_[static_cast<std::size_t>(index)];
    if (node.closed) continue;
    if (best_cost_ <= estimate * (1.0 + config_.suboptimality)) break;
    node.closed = true;
    // Connecting to the goal is dear, so it is tried rarely while the goal is far.
    if (expanded >= next_shot) {
      try_shot(world, goal, index);
      next_shot = expanded + 1 + static_cast<std::size_t>(2.0 * (estimate - node.cost));
      const auto extra = static_cast<std::size_t>(config_.extra_states);
      if (best_node_ >= 0) last = std::min(last, expanded + extra);
    }
    if (expanded % kProgressStates == 0) progress_();
    if (expanded++ >= last) break;
    if (nodes_.size() + 10 > static_cast<std::size_t>(config_.max_states)) {
      if (best_node_ >= 0) break;
      return fail(DrivableFailure::kTooManyStates);
    }
    expand(world, goal, index);
  }
  if (best_node_ < 0) return fail(DrivableFailure::kExhausted);
  DrivablePath path = trace();
  path.states = expanded;
  return path;
}

void DrivableSearch::clear() {
  nodes_.clear();
  keys_.clear();
  open_.clear();
  std::fill(table_.begin(), table_.end(), -1);
  best_node_ = -1;
  best_cost_ = kInfinity;
}

std::uint64_t DrivableSearch::key_of(const GridGeometry& grid, const Node& node) const {
  const auto x = static_cast<std::uint64_t>((node.pose.x - grid.origin.x()) / kCell);
  const auto y = static_cast<std::uint64_t>((node.pose.y - grid.origin.y()) / kCell);
  const double turn = (node.pose.yaw + std::numbers::pi) / (2.0 * std::numbers::pi);
  const auto heading = static_cast<std::uint64_t>(std::lround(turn * kHeadings) % kHeadings);
  return (((y << 20) + x) * kHeadings + heading) * 2 + (node.direction < 0 ? 1 : 0);
}

std::int32_t* DrivableSearch::slot_of(std::uint64_t key) {
  const std::size_t mask = table_.size() - 1;
  std::size_t slot = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 20) & mask;
  while (table_[slot] >= 0 && keys_[static_cast<std::size_t>(table_[slot])] != key) {
    slot = (slot + 1) & mask;
  }
  return &table_[slot];
}

double DrivableSearch::heuristic(const World& world, const Pose2& goal, const Node& node) {
  const GridGeometry& grid = world.grid.geometry();
  double on_grid = world.to_goal.cost_to_goal(grid.cell_of(node.pose.position()));
  // The robot may put its rear axle closer to a wall than a path along it could run.
  if (!std::isfinite(on_grid) && node.parent >= 0) {
    const Pose2& parent = nodes_[static_cast<std::size_t>(node.parent)].pose;
    on_grid = world.to_goal.cost_to_goal(grid.cell_of(parent.position()));
  }
  const Pose2 approach = goal * Pose2{-world.approach, 0.0, 0.0};
  return world.approach +
         std::max(std::isfinite(on_grid) ? on_grid : 0.0, turning_(node.pose, approach));
}

void DrivableSearch::open(const World& world, const Pose2& goal, const Node& node) {
  const std::uint64_t key = key_of(world.grid.geometry(), node);
  std::int32_t* slot = slot_of(key);
  std::int32_t index = *slot;
  if (index >= 0) {
    Node& known = nodes_[static_cast<std::size_t>(index)];
    if (known.closed || known.cost <= node.cost) return;
    known = node;
  } else {
    index = static_cast<std::int32_t>(nodes_.size());
    *slot = index;
    nodes_.push_back(node);
    keys_.push_back(key);
  }
  const double estimate = node.cost + config_.greed * heuristic(world, goal, node);
  open_.emplace_back(static_cast<float>(estimate), index);
  std::push_heap(open_.begin(), open_.end(), std::greater<>{});
}

void DrivableSearch::expand(const World& world, const Pose2& goal, std::int32_t index) {
  const Node node = nodes_[static_cast<std::size_t>(index)];
  const double half_curvature = 0.5 / curves_.turning_radius();
  const ArcCost::Start start{node.pose, CollisionChecker::place(node.pose)};
  for (const int direction : {1, -1}) {
    for (int steering = -2; steering <= 2; ++steering) {
      Arc arc{direction * config_.step, steering * half_curvature};
      ArcCost::Driven driven = arc_cost_.drive(world.grid, world.poses, start, arc);
      if (!driven.free()) {  // in a corner there may be room for half a step
        arc.length *= 0.5;
        driven = arc_cost_.drive(world.grid, world.poses, start, arc);
        if (!driven.free()) continue;
      }
      const double change = arc_cost_.change(node.direction, node.steering * half_curvature, arc);
      open(world, goal,
           {driven.end.pose, static_cast<float>(node.cost + driven.cost + change), index,
            static_cast<float>(arc.length), static_cast<std::int8_t>(steering),
            static_cast<std::int8_t>(direction), false});
    }
  }
}

double DrivableSearch::shot_cost(const World& world, const Node& from, const Shot& shot,
                                 double limit) const {
  double cost = shot.cost;
  ArcCost::Start at{from.pose, CollisionChecker::place(from.pose)};
  const auto add = [&](const Arc& arc) {
    const ArcCost::Driven driven = arc_cost_.drive(world.grid, world.poses, at, arc);
    cost += driven.cost - std::abs(arc.length);
    at = driven.end;
    return cost < limit;
  };
  for (std::size_t i = 0; i < shot.word.count; ++i) {
    if (!add(shot.word.arcs[i])) return kInfinity;
  }
  if (shot.straight > 0.0 && !add({shot.straight, 0.0})) return kInfinity;
  return cost;
}

void DrivableSearch::try_shot(const World& world, const Pose2& goal, std::int32_t index) {
  const Node& node = nodes_[static_cast<std::size_t>(index)];
  const double half_curvature = 0.5 / curves_.turning_radius();
  shots_.clear();
  for (const double straight : approaches_) {
    curves_.connect(node.pose, goal * Pose2{-straight, 0.0, 0.0}, words_);
    for (std::size_t i = 0; i < words_.count; ++i) {
      const ArcPath& word = words_.paths[i];
      double cost = straight;
      int direction = node.direction;
      double curvature = node.steering * half_curvature;
      double run_in = 0.0;  // straight forwards at the end of the word itself
      for (std::size_t k = 0; k < word.count; ++k) {
        const Arc& arc = word.arcs[k];
        if (std::abs(arc.length) < 1e-6) continue;
        cost += std::abs(arc.length) + arc_cost_.change(direction, curvature, arc);
        direction = direction_of(arc);
        curvature = arc.curvature;
        run_in = direction > 0 && arc.curvature == 0.0 ? arc.length : 0.0;
      }
      if (straight > 0.0) cost += arc_cost_.change(direction, curvature, {straight, 0.0});
      const double missing = config_.approach_length - straight - run_in;
      cost += config_.short_approach_cost * std::max(0.0, missing);
      if (node.cost + cost < best_cost_) shots_.push_back({cost, {cost, word, straight}});
    }
  }
  std::sort(shots_.begin(), shots_.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [lower_bound, shot] : shots_) {
    if (node.cost + lower_bound >= best_cost_) break;
    const double cost = shot_cost(world, node, shot, best_cost_ - node.cost);
    if (cost == kInfinity) continue;
    best_cost_ = node.cost + cost;
    best_shot_ = shot;
    best_node_ = index;
  }
}

DrivablePath DrivableSearch::trace() const {
  DrivablePath path;
  path.cost = best_cost_;
  for (std::int32_t i = best_node_; nodes_[static_cast<std::size_t>(i)].parent >= 0;) {
    const Node& node = nodes_[static_cast<std::size_t>(i)];
    path.arcs.push_back({node.length, node.steering * 0.5 / curves_.turning_radius()});
    i = node.parent;
  }
  std::reverse(path.arcs.begin(), path.arcs.end());
  for (std::size_t k = 0; k < best_shot_.word.count; ++k) {
    if (std::abs(best_shot_.word.arcs[k].length) > 1e-6) {
      path.arcs.push_back(best_shot_.word.arcs[k]);
    }
  }
  if (best_shot_.straight > 0.0) path.arcs.push_back({best_shot_.straight, 0.0});
  return path;
}

std::vector<Pose2> sample(const std::vector<Arc>& arcs, const Pose2& start, double spacing) {
  std::vector<Pose2> poses{start};
  Pose2 from = start;
  for (const Arc& arc : arcs) {
    const int parts =
        std::max(1, static_cast<int>(std::ceil(std::abs(arc.length) / spacing - 1e-6)));
    for (int i = 1; i <= parts; ++i) {
      poses.push_back(advance(from, {arc.length * i / parts, arc.curvature}));
    }
    from = poses.back();
  }
  return poses;
}

}  // namespace coop::global_planner
