#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "core/random.hpp"
#include "sequencer/cost_matrix.hpp"

namespace coop::sequencer::test {

inline CostMatrix distances(const std::vector<Eigen::Vector2d>& places) {
  CostMatrix costs(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < places.size(); ++j) costs.at(i, j) = (places[i] - places[j]).norm();
  }
  return costs;
}

inline CostMatrix random_places(std::size_t count, std::uint64_t seed) {
  RandomStream random(seed, "places");
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < count; ++i) {
    places.emplace_back(random.uniform(0, 14), random.uniform(0, 9));
  }
  return distances(places);
}

/// Uphill is dearer: there and back differ, by much or little.
inline CostMatrix asymmetric_places(std::size_t count, std::uint64_t seed) {
  CostMatrix costs = random_places(count, seed);
  RandomStream random(seed, "slopes");
  for (double& cost : costs.cost) cost *= random.uniform(1.0, 2.0);
  return costs;
}

inline double cheapest_by_trying_all(const CostMatrix& costs, bool closed) {
  std::vector<std::size_t> order(costs.size - 1);
  std::iota(order.begin(), order.end(), std::size_t{1});
  double best = std::numeric_limits<double>::infinity();
  do {
    best = std::min(best, tour_cost(costs, order, closed));
  } while (std::ranges::next_permutation(order).found);
  return best;
}

/// Whether the order holds each of 1 to nodes-1 once.
inline bool visits_all_once(std::vector<std::size_t> order, std::size_t nodes) {
  std::ranges::sort(order);
  std::vector<std::size_t> expected(nodes - 1);
  std::iota(expected.begin(), expected.end(), std::size_t{1});
  return order == expected;
}

}  // namespace coop::sequencer::test
