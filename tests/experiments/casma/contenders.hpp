#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/search/grid_planner.hpp"
#include "global_planner/swarm/optimiser.hpp"

namespace coop::casma {

/// A planner under a name; the seed decides all its draws.
struct Contender {
  std::string name;
  std::string paper_name;  ///< in the paper's tables; empty: not there
  std::function<std::unique_ptr<GridPlanner>(std::uint64_t seed)> make;
};

/// All planners, those of the paper first, with the parameters of table 8.
[[nodiscard]] std::vector<Contender> contenders();
/// Those that take part in the experiment with moving pigs.
[[nodiscard]] std::vector<Contender> moving_contenders();

/// A swarm for functions under a name.
struct Searcher {
  std::string name;
  std::string paper_name;
  std::function<std::unique_ptr<global_planner::swarm::Optimiser>()> make;
};

/// Those of table 3, then those whose equations are taken to the letter.
[[nodiscard]] std::vector<Searcher> searchers();

}  // namespace coop::casma
