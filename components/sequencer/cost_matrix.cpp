#include "sequencer/cost_matrix.hpp"

namespace coop::sequencer {

double tour_cost(const CostMatrix& costs, const std::vector<std::size_t>& order, bool closed) {
  double sum = 0.0;
  std::size_t here = 0;
  for (const std::size_t next : order) {
    sum += costs.at(here, next);
    here = next;
  }
  return closed && !order.empty() ? sum + costs.at(here, 0) : sum;
}

CostMatrix part_of(const CostMatrix& costs, const std::vector<std::size_t>& nodes) {
  CostMatrix part(nodes.size());
  for (std::size_t from = 0; from < nodes.size(); ++from) {
    for (std::size_t to = 0; to < nodes.size(); ++to) {
      part.at(from, to) = costs.at(nodes[from], nodes[to]);
    }
  }
  return part;
}

}  // namespace coop::sequencer
