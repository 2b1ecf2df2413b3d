#pragma once
#include <cstdint>
#include <vector>

#include "core/random.hpp"

namespace coop::global_planner::swarm {

/// The formulas of the slime mould algorithm with cellular automata (the CASMA paper's equations 2
/// to 7 and table 1), shared by its search in a box and its search on a grid. How each is read
/// where the paper leaves it open: docs/experiments/casma.md.
namespace slime {

/// Equation 2, W of one individual; `r` in [0, 1). The logarithm's base is 10: only then does W
/// come to lie in the intervals the paper names, [1, 1.3] for the better half, [0.7, 1] for the
/// others. best: bF, worst: wF of this iteration.
[[nodiscard]] double weight(bool in_better_half, double r, double fitness, double best,
                            double worst);

/// Equation 4, p; `best_ever`: DF.
[[nodiscard]] double chance_of_approach(double fitness, double best_ever);

/// Equation 5, a and b, which the paper leaves open: arctanh(1 - t/T) and 1 - t/T, as in the slime
/// mould algorithm it builds on (Li et al. 2020). t = 1 ... T.
[[nodiscard]] double approach_range(int iteration, int iterations);
[[nodiscard]] double contraction_range(int iteration, int iterations);

/// Equation 6's second factor, 1 - exp(-((T - t) / t)^2): falls from 1 to 0.
[[nodiscard]] double fading(int iteration, int iterations);

}  // namespace slime

/// Pheromone in cells: 3e-4 at first and 1e-4 more for each visit (the paper, below table 2).
class CellPheromone {
 public:
  static constexpr double kInitial = 3e-4;
  static constexpr double kVisit = 1e-4;

  void reset(std::size_t cells);
  void visit(std::size_t cell);
  [[nodiscard]] double at(std::size_t cell) const { return amount_[cell]; }
  /// Equation 6 as printed: (C_init - C_cur) * fading. Its magnitude is that of the pheromone.
  [[nodiscard]] double printed_weight(std::size_t cell, double fading) const {
    return (kInitial - amount_[cell]) * fading;
  }
  /// Equation 6 in the range that table 2 states, [0, 1]: the difference to the strongest cell, as
  /// a share of it.
  [[nodiscard]] double weight(std::size_t cell, double fading) const {
    return (1.0 - amount_[cell] / strongest_) * fading;
  }

 private:
  std::vector<double> amount_;
  double strongest_ = kInitial;
};

/// The individuals' standing in one iteration.
class Ranking {
 public:
  /// Marks the better half and finds best and worst; lower is better.
  void update(const std::vector<double>& fitness);
  [[nodiscard]] bool in_better_half(std::size_t i) const { return better_[i] != 0; }
  [[nodiscard]] double best() const { return best_; }
  [[nodiscard]] double worst() const { return worst_; }
  [[nodiscard]] std::size_t leader() const { return leader_; }

 private:
  std::vector<std::uint32_t> order_;
  std::vector<std::uint8_t> better_;
  double best_ = 0.0;
  double worst_ = 0.0;
  std::size_t leader_ = 0;
};

}  // namespace coop::global_planner::swarm
