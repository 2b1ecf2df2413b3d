#pragma once
#include <string>

#include "core/random.hpp"
#include "global_planner/swarm/cell_wave.hpp"
#include "global_planner/swarm/four_way.hpp"
#include "global_planner/swarm/slime_mould.hpp"

namespace coop::global_planner::swarm {

struct CasmaConfig {
  /// best: the automaton carries the food's scent through the grid, moulds climb it.
  /// paper: equations 2 to 7 as docs/experiments/casma.md reads them.
  /// printed: equations 6 and 7 to the letter.
  std::string method = "best";
  int population = 100;  ///< moulds of `paper` and `printed` (table 8)
  int iterations = 500;  ///< of those (table 8)
  double z = 0.3;        ///< share of random moves (table 8)
  int climbers = 20;     ///< moulds of `best`

  void describe(config::Fields& fields);
};

/// A population of moulds that crawl over the grid by equation 7, one cell an iteration, each to
/// the neighbour nearest to where the equation would put it. All begin at the start; fitness is the
/// Manhattan distance to the goal. Every mould that comes to the goal offers its trail without
/// loops, and so does the pheromone left: the walk along its strongest cells.
class CrawlingMoulds {
 public:
  explicit CrawlingMoulds(const CasmaConfig& config) : config_(config) {}

  /// The shortest trail found; empty where no mould has come to the goal.
  const Track& search(const TraversalGrid& grid, Cell start, Cell goal, RandomStream& random);

 private:
  struct Aim {
    double x = 0.0;
    double y = 0.0;
  };
  void reset(const TraversalGrid& grid, std::uint32_t start, Cell goal);
  [[nodiscard]] Aim aim(const TraversalGrid& grid, std::size_t mould, int iteration,
                        RandomStream& random);
  void crawl(const TraversalGrid& grid, std::size_t mould, const Aim& aim, RandomStream& random);
  void follow_pheromone(const TraversalGrid& grid, std::uint32_t start, std::uint32_t goal);
  void offer(Track& track, std::size_t cells);

  CasmaConfig config_;
  Ranking ranking_;
  CellPheromone pheromone_;
  std::vector<Track> trails_;  ///< a mould's cells from the start to where it is
  std::vector<Cell> at_;       ///< where it is
  std::vector<Cell> before_;   ///< at the beginning of the iteration
  std::vector<double> fitness_;
  std::vector<std::uint8_t> arrived_;
  std::vector<std::uint8_t> visited_;
  Cell best_place_;
  double best_fitness_ = 0.0;
  Track candidate_;
  Track best_;
  LoopEraser eraser_;
};

/// Moulds that climb the food's scent over the cheapest cells; among the many cheapest paths they
/// find one of few turns. The first keeps its direction wherever it can, the others leave it with
/// chance z.
class ClimbingMoulds {
 public:
  explicit ClimbingMoulds(const CasmaConfig& config) : config_(config) {}

  /// A cheapest path; empty where there is none.
  const Track& search(const TraversalGrid& grid, Cell start, Cell goal, RandomStream& random);

 private:
  /// Turns on the way; more than `most` where it has given up.
  int climb(const TraversalGrid& grid, std::uint32_t start, double z, int most,
            RandomStream& random);

  CasmaConfig config_;
  CellWave wave_;
  Track candidate_;
  Track best_;
};

/// CASMA as planner. kNoPath also where the method has found none.
class Casma final : public GridPlanner {
 public:
  Casma(const CasmaConfig& config, const RandomStream& random)
      : config_(config), random_(random), crawling_(config), climbing_(config) {}

  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;

 private:
  CasmaConfig config_;
  RandomStream random_;
  CrawlingMoulds crawling_;
  ClimbingMoulds climbing_;
};

}  // namespace coop::global_planner::swarm
