#include "global_planner/swarm/ant_sampler.hpp"

#include <algorithm>
#include <limits>

namespace coop::global_planner::swarm {

void AntSamplerConfig::describe(config::Fields& fields) {
  swarm.describe(fields);
  fields.number("pheromone", pheromone, {.help = "at first", .min = 1e-6, .max = 1e6});
  fields.number("evaporation", evaporation,
                {.help = "share lost an iteration", .min = 0, .max = 1});
  fields.integer("levels", levels, {.help = "values of a dimension", .min = 2, .max = 100000});
}

Minimum AntSampler::minimise(Objective& objective, RandomStream& random,
                             std::vector<double>* course) {
  const std::size_t dimensions = objective.lower().size();
  const auto levels = static_cast<std::size_t>(config_.levels);
  pheromone_.assign(dimensions * levels, config_.pheromone);
  sums_.resize(pheromone_.size());
  std::vector<std::size_t> ant(dimensions);
  std::vector<std::size_t> best_ant;
  std::vector<std::size_t> best_ever;
  Minimum best{std::vector<double>(dimensions), std::numeric_limits<double>::infinity()};
  std::vector<double> place(dimensions);
  for (int t = 0; t < config_.swarm.iterations; ++t) {
    sum_up();
    double lowest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < config_.swarm.population; ++i) {
      for (std::size_t d = 0; d < dimensions; ++d) {
        ant[d] = choose(d, random);
        const double share = static_cast<double>(ant[d]) / static_cast<double>(levels - 1);
        place[d] = objective.lower()[d] + share * (objective.upper()[d] - objective.lower()[d]);
      }
      const double value = objective(place);
      if (value >= lowest) continue;
      lowest = value;
      best_ant = ant;
      if (value >= best.value) continue;
      best = {place, value};
      best_ever = ant;
    }
    // Nothing falls to zero for good: every level keeps a small chance.
    for (double& amount : pheromone_) {
      amount = std::max(amount * (1.0 - config_.evaporation), 1e-4 * config_.pheromone);
    }
    leave(best_ant);
    leave(best_ever);
    if (course != nullptr) course->push_back(best.value);
  }
  return best;
}

void AntSampler::sum_up() {
  const auto levels = static_cast<std::size_t>(config_.levels);
  for (std::size_t i = 0; i < pheromone_.size(); ++i) {
    sums_[i] = pheromone_[i] + (i % levels == 0 ? 0.0 : sums_[i - 1]);
  }
}

std::size_t AntSampler::choose(std::size_t dimension, RandomStream& random) const {
  const auto levels = static_cast<std::size_t>(config_.levels);
  const auto row = sums_.begin() + static_cast<std::ptrdiff_t>(dimension * levels);
  const auto end = row + static_cast<std::ptrdiff_t>(levels);
  const auto found = std::upper_bound(row, end, random.uniform() * *(end - 1));
  return std::min(static_cast<std::size_t>(found - row), levels - 1);
}

void AntSampler::leave(const std::vector<std::size_t>& levels) {
  // On the neighbouring levels half as much, so that the search can slide along a row.
  const auto count = static_cast<std::size_t>(config_.levels);
  for (std::size_t d = 0; d < levels.size(); ++d) {
    double* row = pheromone_.data() + d * count;
    row[levels[d]] += config_.pheromone;
    if (levels[d] > 0) row[levels[d] - 1] += 0.5 * config_.pheromone;
    if (levels[d] + 1 < count) row[levels[d] + 1] += 0.5 * config_.pheromone;
  }
}

}  // namespace coop::global_planner::swarm
