#include "sequencer/ordering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sequencer/held_karp.hpp"

namespace coop::sequencer {
namespace {

bool is_way(double cost) {
  return std::isfinite(cost) && cost >= 0.0;
}

/// In place of no way a price that no tour pays which can do without.
CostMatrix without_gaps(const CostMatrix& costs) {
  double largest = 1.0;
  for (const double cost : costs.cost) {
    if (is_way(cost)) largest = std::max(largest, cost);
  }
  const double dear = 2.0 * largest * static_cast<double>(costs.size);
  CostMatrix whole = costs;
  for (double& cost : whole.cost) {
    if (!is_way(cost)) cost = dear;
  }
  return whole;
}

}  // namespace

Ordering order_nodes(const CostMatrix& costs, OrderingMethod method, const AntColonyConfig& colony,
                     const MaxMinConfig& max_min, OrderingStreams& streams) {
  Ordering ordering;
  std::vector<std::size_t> reachable;
  for (std::size_t node = 0; node < costs.size; ++node) {
    const bool is_reachable = node == 0 || is_way(costs.at(0, node));
    (is_reachable ? reachable : ordering.unreachable).push_back(node);
  }
  if (reachable.size() <= 1) return ordering;
  CostMatrix part = part_of(costs, reachable);
  for (double& cost : part.cost) {
    if (!is_way(cost)) cost = std::numeric_limits<double>::infinity();
  }
  const CostMatrix whole = without_gaps(part);

  const auto solve = [&](OrderingMethod by) {
    if (by == OrderingMethod::kPaper) return solve_by_ant_colony(whole, colony, streams.paper);
    if (whole.size <= kMaxExactTargets + 1) return solve_exactly(whole, colony.closed);
    return solve_by_max_min_ants(whole, colony.closed, max_min, streams.best);
  };
  if (whole.size <= kMaxCompared) {
    const auto other =
        method == OrderingMethod::kPaper ? OrderingMethod::kBest : OrderingMethod::kPaper;
    ordering.alternative_cost = tour_cost(part, solve(other).order, colony.closed);
  }
  ordering.tour = solve(method);
  ordering.tour.cost = tour_cost(part, ordering.tour.order, colony.closed);
  for (std::size_t& node : ordering.tour.order) node = reachable[node];
  return ordering;
}

}  // namespace coop::sequencer
