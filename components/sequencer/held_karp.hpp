#pragma once
#include "sequencer/cost_matrix.hpp"

namespace coop::sequencer {

/// Nodes besides the start up to which the exact method is quick (n^2 2^n steps).
inline constexpr std::size_t kMaxExactTargets = 12;

/// The cheapest order, exactly (Held and Karp 1962). Precondition: at most kMaxExactTargets
/// targets.
[[nodiscard]] Tour solve_exactly(const CostMatrix& costs, bool closed);

}  // namespace coop::sequencer
