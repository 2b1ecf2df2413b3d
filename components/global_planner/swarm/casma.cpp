#include "global_planner/swarm/casma.hpp"

#include <array>
#include <limits>
#include <string_view>

namespace coop::global_planner::swarm {

void CasmaConfig::describe(config::Fields& fields) {
  static constexpr std::array<std::string_view, 3> kMethods{"best", "paper", "printed"};
  fields.choice("method", method, kMethods, {.help = "best, or one of the paper's readings"});
  fields.integer("population", population,
                 {.help = "moulds of the paper's readings", .min = 2, .max = 10000});
  fields.integer("iterations", iterations,
                 {.help = "of the paper's readings", .min = 1, .max = 100000});
  fields.number("z", z, {.help = "share of random moves", .min = 0, .max = 1});
  fields.integer("climbers", climbers, {.help = "moulds of best", .min = 1, .max = 10000});
}

Result<GridPath, SearchFailure> Casma::plan(const TraversalGrid& grid, Cell start, Cell goal) {
  if (const auto failure = check_ends(grid, start, goal)) return fail(*failure);
  const Track& track = config_.method == "best" ? climbing_.search(grid, start, goal, random_)
                                                : crawling_.search(grid, start, goal, random_);
  if (track.empty()) return fail(SearchFailure::kNoPath);
  return path_of(grid, track);
}

const Track& ClimbingMoulds::search(const TraversalGrid& grid, Cell start, Cell goal,
                                    RandomStream& random) {
  best_.clear();
  const std::uint32_t from = grid.padded_index(start);
  if (!wave_.spread(grid, grid.padded_index(goal), from)) return best_;
  int fewest = std::numeric_limits<int>::max();
  for (int i = 0; i < config_.climbers && fewest > 0; ++i) {
    const int turns = climb(grid, from, i == 0 ? 0.0 : config_.z, fewest - 1, random);
    if (turns >= fewest) continue;
    fewest = turns;
    best_.swap(candidate_);
  }
  return best_;
}

int ClimbingMoulds::climb(const TraversalGrid& grid, std::uint32_t start, double z, int most,
                          RandomStream& random) {
  const auto offsets = neighbour_offsets(grid);
  const auto threshold = static_cast<std::uint64_t>(z * 0x1.0p32);
  std::uint32_t here = start;
  std::uint32_t step = 0;
  int turns = 0;
  candidate_.assign(1, start);
  while (wave_.cost(here) > 0.0F) {
    // Where the scent has come from, by the sum it was made with: equal to the bit.
    const float half = 0.5F * grid.factor(here);
    const auto leads_on = [&](std::uint32_t offset) {
      const std::uint32_t there = here + offset;
      return wave_.cost(there) + 0.5F * grid.factor(there) + half == wave_.cost(here);
    };
    const std::uint64_t lot = threshold > 0 ? random() : 0;
    const bool keep_on = step != 0 && (threshold == 0 || (lot >> 32) >= threshold);
    if (!keep_on || !leads_on(step)) {
      const std::uint32_t before = step;
      // From a direction drawn on, the first that leads on.
      const std::size_t first = lot & 3U;
      for (std::size_t i = 0; i < offsets.size(); ++i) {
        step = offsets[(first + i) & 3U];
        if (leads_on(step)) break;
      }
      if (before != 0 && step != before && ++turns > most) return turns;
    }
    here += step;
    candidate_.push_back(here);
  }
  return turns;
}

}  // namespace coop::global_planner::swarm
