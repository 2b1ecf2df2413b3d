#include "global_planner/swarm/slime_optimiser.hpp"

#include <algorithm>

namespace coop::global_planner::swarm {

void SlimeOptimiserConfig::describe(config::Fields& fields) {
  swarm.describe(fields);
  fields.number("z", z, {.help = "share of individuals placed at random", .min = 0, .max = 1});
  fields.flag("as_printed", as_printed, {.help = "equations 6 and 7 to the letter"});
  fields.integer("cells", cells,
                 {.help = "of the cellular automaton along a dimension", .min = 1, .max = 1000});
}

Minimum SlimeOptimiser::minimise(Objective& objective, RandomStream& random,
                                 std::vector<double>* course) {
  Population moulds(objective, config_.swarm.population, random);
  pheromone_.reset(static_cast<std::size_t>(config_.cells) *
                   static_cast<std::size_t>(config_.cells));
  for (int t = 1; t <= config_.swarm.iterations; ++t) {
    ranking_.update(moulds.values());
    before_.assign(moulds.at(0).data(), moulds.at(0).data() + moulds.size() * moulds.dimensions());
    for (std::size_t i = 0; i < moulds.size(); ++i) update(moulds, i, t, random);
    for (std::size_t i = 0; i < moulds.size(); ++i) {
      moulds.judge(i);
      pheromone_.visit(cell_of(moulds, i));
    }
    if (course != nullptr) course->push_back(moulds.best().value);
  }
  return moulds.best();
}

std::size_t SlimeOptimiser::cell_of(Population& moulds, std::size_t i) const {
  std::size_t cell = 0;
  const auto per_side = static_cast<std::size_t>(config_.cells);
  for (std::size_t d = 0; d < std::min<std::size_t>(2, moulds.dimensions()); ++d) {
    const double share = (moulds.at(i)[d] - moulds.low(d)) / moulds.span(d);
    const auto along = static_cast<std::size_t>(share * static_cast<double>(per_side));
    cell = cell * per_side + std::min(along, per_side - 1);
  }
  return cell;
}

void SlimeOptimiser::update(Population& moulds, std::size_t i, int iteration,
                            RandomStream& random) {
  const int last = config_.swarm.iterations;
  const std::size_t dimensions = moulds.dimensions();
  const double fading = slime::fading(iteration, last);
  const std::size_t cell = cell_of(moulds, i);
  const double c_omega = config_.as_printed ? pheromone_.printed_weight(cell, fading)
                                            : pheromone_.weight(cell, fading);
  const std::span<double> place = moulds.at(i);
  const double r = random.uniform();
  if ((config_.as_printed ? c_omega : r) < config_.z) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      const double share = config_.as_printed ? c_omega : c_omega * random.uniform();
      place[d] = share * moulds.span(d) + moulds.low(d);
    }
    return;
  }
  if (r < slime::chance_of_approach(moulds.value(i), moulds.best().value)) {
    const double a = slime::approach_range(iteration, last);
    const std::size_t one = random.below(moulds.size()) * dimensions;
    const std::size_t other = random.below(moulds.size()) * dimensions;
    for (std::size_t d = 0; d < dimensions; ++d) {
      const double w = slime::weight(ranking_.in_better_half(i), random.uniform(), moulds.value(i),
                                     ranking_.best(), ranking_.worst());
      place[d] = moulds.best().place[d] +
                 random.uniform(-a, a) * (w * before_[one + d] - before_[other + d]);
    }
    return;
  }
  const double b = slime::contraction_range(iteration, last);
  for (std::size_t d = 0; d < dimensions; ++d) place[d] *= random.uniform(-b, b);
}

}  // namespace coop::global_planner::swarm
