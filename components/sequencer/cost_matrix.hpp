#pragma once
#include <cstddef>
#include <vector>

namespace coop::sequencer {

/// Costs of driving between places, metres weighted by the cells' costs; node 0 is where the robot
/// stands. Infinite: no way.
struct CostMatrix {
  std::size_t size = 0;
  std::vector<double> cost;  ///< row by row: from, to

  CostMatrix() = default;
  explicit CostMatrix(std::size_t nodes, double value = 0.0)
      : size(nodes), cost(nodes * nodes, value) {}
  [[nodiscard]] double& at(std::size_t from, std::size_t to) { return cost[from * size + to]; }
  [[nodiscard]] double at(std::size_t from, std::size_t to) const { return cost[from * size + to]; }
};

/// An order of all nodes but the start, and its cost.
struct Tour {
  std::vector<std::size_t> order;  ///< nodes 1 to size-1, each once
  double cost = 0.0;
};

/// Cost of driving from node 0 through `order`, and back to node 0 where `closed`.
[[nodiscard]] double tour_cost(const CostMatrix& costs, const std::vector<std::size_t>& order,
                               bool closed);

/// The rows and columns of `nodes` alone, in that order.
[[nodiscard]] CostMatrix part_of(const CostMatrix& costs, const std::vector<std::size_t>& nodes);

}  // namespace coop::sequencer
