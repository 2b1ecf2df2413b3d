#include "global_planner/swarm/fireflies.hpp"

#include <cmath>

namespace coop::global_planner::swarm {

void FirefliesConfig::describe(config::Fields& fields) {
  swarm.describe(fields);
  fields.number("gamma", gamma, {.help = "decay of light", .min = 0, .max = 1000});
  fields.number("alpha", alpha,
                {.help = "of the random step, in sides of the box", .min = 0, .max = 1});
  fields.number("beta", beta, {.help = "attraction at no distance", .min = 0, .max = 10});
  fields.number("cooling", cooling, {.help = "alpha's factor an iteration", .min = 0, .max = 1});
  fields.flag("as_printed", as_printed, {.help = "brighter fireflies repel, as in equation 11"});
}

Minimum Fireflies::minimise(Objective& objective, RandomStream& random,
                            std::vector<double>* course) {
  Population flies(objective, config_.swarm.population, random);
  double alpha = config_.alpha;
  for (int t = 0; t < config_.swarm.iterations; ++t) {
    for (std::size_t i = 0; i < flies.size(); ++i) {
      attract(flies, i, alpha, random);
      flies.judge(i);
    }
    alpha *= config_.cooling;
    if (course != nullptr) course->push_back(flies.best().value);
  }
  return flies.best();
}

void Fireflies::attract(Population& flies, std::size_t i, double alpha,
                        RandomStream& random) const {
  const std::span<double> place = flies.at(i);
  const double sign = config_.as_printed ? -1.0 : 1.0;
  bool moved = false;
  for (std::size_t j = 0; j < flies.size(); ++j) {
    if (flies.value(j) >= flies.value(i)) continue;
    const std::span<const double> brighter = flies.at(j);
    double squared = 0.0;
    for (std::size_t d = 0; d < place.size(); ++d) {
      const double apart = (brighter[d] - place[d]) / flies.span(d);
      squared += apart * apart;
    }
    const double pull = sign * config_.beta * std::exp(-config_.gamma * squared);
    for (std::size_t d = 0; d < place.size(); ++d) {
      place[d] +=
          pull * (brighter[d] - place[d]) + alpha * (random.uniform() - 0.5) * flies.span(d);
    }
    moved = true;
  }
  if (moved) return;
  // Nobody is brighter: a random step, as the equation has it without a second firefly.
  for (std::size_t d = 0; d < place.size(); ++d) {
    place[d] += alpha * (random.uniform() - 0.5) * flies.span(d);
  }
}

}  // namespace coop::global_planner::swarm
