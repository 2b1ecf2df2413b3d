#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/casma/contenders.hpp"
#include "experiments/casma/paper_data.hpp"
#include "experiments/casma/pen.hpp"

namespace coop::casma {

struct StageOptions {
  int seeds = 500;
  std::uint64_t first_seed = 1;
  int jobs = 1;
  /// Set from outside: the stage ends soon, its result is of no use.
  const std::atomic<bool>* stop = nullptr;
  /// Told now and then how much of the stage is done; from any thread, one at a time.
  std::function<void(const std::string& stage, std::size_t done, std::size_t total)> progress;
};

/// Runs `work` for 0 ... count - 1, `jobs` at once; an exception ends it and is thrown on.
void run_all(const std::string& stage, std::size_t count, const StageOptions& options,
             const std::function<void(std::size_t)>& work);

/// Processor time of the calling thread, microseconds.
[[nodiscard]] double thread_time_us();

/// A swarm on the Rosenbrock function over [-2.048, 2.048]^2.
struct RosenbrockRun {
  std::size_t searcher = 0;  ///< in searchers()
  std::vector<double> place;
  double value = 0.0;
  std::vector<double> course;  ///< best value after each iteration
  double time_us = 0.0;
};
inline constexpr int kRosenbrockRuns = 10;
[[nodiscard]] double rosenbrock(const std::vector<double>& place);
[[nodiscard]] std::vector<RosenbrockRun> run_rosenbrock(const StageOptions& options);

/// A planner's plan on one of the paper's maps.
struct PlanRun {
  std::size_t map = 0;        ///< in Paper::maps
  std::size_t contender = 0;  ///< in contenders()
  std::uint64_t seed = 0;
  bool found = false;
  std::vector<Cell> path;
  PathCheck check;
  int turns = 0;
  double time_us = 0.0;  ///< of a planner's first plan, its memory included
};
[[nodiscard]] std::vector<PlanRun> run_maps(const Paper& paper, const StageOptions& options);

/// The fewest cells from start to goal, by Dijkstra's algorithm; 0: there is no way.
[[nodiscard]] int fewest_cells(const Grid<Cost>& pen, Cell start, Cell goal);

/// A robot's way through moving pigs.
struct MovingRun {
  std::size_t map = 0;
  std::size_t contender = 0;  ///< in moving_contenders()
  std::uint64_t seed = 0;
  bool arrived = false;
  int steps = 0;  ///< cells moved
  int waits = 0;  ///< ticks without a move: no path, or the goal under a pig
  int plans = 0;
  int touched = 0;       ///< ticks in which the robot stood under a pig
  double time_us = 0.0;  ///< of all planning
};
inline constexpr int kPigReach = 3;  ///< cells a pig walks at most in a tick
/// CASMA as the paper has it needs seconds a trial: it takes part with every 20th seed.
inline constexpr int kSlowStride = 20;
inline constexpr int kMostTicks = 500;  ///< then a trial has failed
/// One trial: the robot plans, moves a cell, the pigs walk; until it stands on the goal.
[[nodiscard]] MovingRun run_moving_trial(const Paper& paper, std::size_t map, GridPlanner& planner,
                                         std::uint64_t seed);
[[nodiscard]] std::vector<MovingRun> run_moving(const Paper& paper, const StageOptions& options);

/// A plan in the pilot pen among pigs at random places.
struct PilotPlan {
  std::size_t run = 0;  ///< in Paper::pilot
  std::uint64_t seed = 0;
  int steps = 0;               ///< of CASMA best, moves; 0: no path
  int fewest = 0;              ///< by exact search, moves
  int paper_method_steps = 0;  ///< of CASMA paper; 0: none found
  double time_us = 0.0;
};
inline constexpr int kPilotWidth = 20;
inline constexpr int kPilotHeight = 12;
[[nodiscard]] std::vector<PilotPlan> run_pilot(const Paper& paper, const StageOptions& options);

}  // namespace coop::casma
