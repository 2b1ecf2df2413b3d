#pragma once
#include "core/random.hpp"
#include "sequencer/ant_colony.hpp"
#include "sequencer/max_min_ants.hpp"

namespace coop::sequencer {

/// Paper: the ant colony of the egg paper. Best: exact up to kMaxExactTargets, MAX-MIN ants beyond.
enum class OrderingMethod : std::uint8_t { kPaper, kBest };

/// Numbers for each colony, so that the use of one does not shift the other's.
struct OrderingStreams {
  RandomStream paper;
  RandomStream best;
};

struct Ordering {
  Tour tour;                             ///< of the nodes that can be reached
  double alternative_cost = 0.0;         ///< by the other method; 0: not computed
  std::vector<std::size_t> unreachable;  ///< nodes no way leads to from node 0, ascending
};

/// An order of all nodes but node 0. A cost that is infinite, negative or no number is no way; a
/// node without a way from node 0 is set aside, so that it cannot spoil the order of the others.
/// Where the others cannot all be joined either, the tour's cost is infinite.
///
/// Whether the tour is closed says `colony.closed`. Above kMaxCompared nodes the other method is
/// not asked: the paper's colony takes n^2 steps an ant.
[[nodiscard]] Ordering order_nodes(const CostMatrix& costs, OrderingMethod method,
                                   const AntColonyConfig& colony, const MaxMinConfig& max_min,
                                   OrderingStreams& streams);

inline constexpr std::size_t kMaxCompared = 128;

}  // namespace coop::sequencer
