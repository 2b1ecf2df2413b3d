#include "global_planner/swarm/optimiser.hpp"

#include <algorithm>
#include <limits>

namespace coop::global_planner::swarm {

void PopulationConfig::describe(config::Fields& fields) {
  fields.integer("population", population,
                 {.help = "individuals (table 8: 100)", .min = 2, .max = 10000});
  fields.integer("iterations", iterations,
                 {.help = "iterations of a search (table 8: 500)", .min = 1, .max = 100000});
}

Population::Population(Objective& objective, int size, RandomStream& random)
    : objective_(&objective),
      lower_(objective.lower()),
      upper_(objective.upper()),
      places_(static_cast<std::size_t>(size) * lower_.size()),
      values_(static_cast<std::size_t>(size)) {
  best_.value = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const std::span<double> place = at(i);
    for (std::size_t d = 0; d < place.size(); ++d) place[d] = random.uniform(lower_[d], upper_[d]);
    judge(i);
  }
}

double Population::judge(std::span<double> place) {
  for (std::size_t d = 0; d < place.size(); ++d) {
    // Written so that what is not a number comes to the lower side.
    place[d] = place[d] > lower_[d] ? std::min(place[d], upper_[d]) : lower_[d];
  }
  const double value = (*objective_)(place);
  if (value < best_.value) {
    best_.value = value;
    best_.place.assign(place.begin(), place.end());
  }
  return value;
}

void Population::move(std::size_t i, std::span<const double> place, double value) {
  std::ranges::copy(place, at(i).begin());
  values_[i] = value;
}

}  // namespace coop::global_planner::swarm
