#include "global_planner/swarm/slime_mould.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coop::global_planner::swarm {
namespace slime {

double weight(bool in_better_half, double r, double fitness, double best, double worst) {
  // Where all are alike the paper divides by zero; their quotient counts as none.
  const double share = worst > best ? (fitness - best) / (worst - best) : 0.0;
  const double change = r * std::log10(share + 1.0);
  return in_better_half ? 1.0 + change : 1.0 - change;
}

double chance_of_approach(double fitness, double best_ever) {
  return std::tanh(std::abs(fitness - best_ever));
}

double approach_range(int iteration, int iterations) {
  return std::atanh(1.0 - static_cast<double>(iteration) / iterations);
}

double contraction_range(int iteration, int iterations) {
  return 1.0 - static_cast<double>(iteration) / iterations;
}

double fading(int iteration, int iterations) {
  const double ratio = static_cast<double>(iterations - iteration) / iteration;
  return 1.0 - std::exp(-ratio * ratio);
}

}  // namespace slime

void CellPheromone::reset(std::size_t cells) {
  amount_.assign(cells, kInitial);
  strongest_ = kInitial;
}

void CellPheromone::visit(std::size_t cell) {
  amount_[cell] += kVisit;
  strongest_ = std::max(strongest_, amount_[cell]);
}

void Ranking::update(const std::vector<double>& fitness) {
  order_.resize(fitness.size());
  better_.assign(fitness.size(), 0);
  std::iota(order_.begin(), order_.end(), 0U);
  const auto middle = order_.begin() + static_cast<std::ptrdiff_t>(order_.size() / 2);
  // The index decides among equals, so that the result is the same with every library.
  std::ranges::nth_element(order_, middle, [&](std::uint32_t a, std::uint32_t b) {
    return fitness[a] < fitness[b] || (fitness[a] == fitness[b] && a < b);
  });
  for (auto it = order_.begin(); it != middle; ++it) better_[*it] = 1;
  const auto [low, high] = std::ranges::minmax_element(fitness);
  best_ = *low;
  worst_ = *high;
  leader_ = static_cast<std::size_t>(low - fitness.begin());
}

}  // namespace coop::global_planner::swarm
