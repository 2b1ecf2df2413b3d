#include "global_planner/swarm/wolf_pack.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coop::global_planner::swarm {

void WolfPackConfig::describe(config::Fields& fields) {
  swarm.describe(fields);
  fields.number("contraction", contraction, {.help = "walpha of table 8", .min = 0, .max = 2});
  fields.number("exploration", exploration, {.help = "wbeta of table 8", .min = 0, .max = 1});
  fields.number("renewal", renewal, {.help = "share of wolves born anew", .min = 0, .max = 1});
}

Minimum WolfPack::minimise(Objective& objective, RandomStream& random,
                           std::vector<double>* course) {
  Population wolves(objective, config_.swarm.population, random);
  trial_.resize(wolves.dimensions());
  const auto scouts =
      static_cast<std::size_t>(config_.exploration * static_cast<double>(wolves.size()));
  for (int t = 0; t < config_.swarm.iterations; ++t) {
    const double left = 1.0 - static_cast<double>(t) / config_.swarm.iterations;
    for (std::size_t i = 0; i < wolves.size(); ++i) {
      if (i < scouts) {
        scout(wolves, i, config_.exploration * left, random);
      } else {
        besiege(wolves, i, config_.contraction * left, random);
      }
    }
    renew(wolves, random);
    if (course != nullptr) course->push_back(wolves.best().value);
  }
  return wolves.best();
}

void WolfPack::go_if_better(Population& wolves, std::size_t i) {
  const double value = wolves.judge(trial_);
  if (value < wolves.value(i)) wolves.move(i, trial_, value);
}

void WolfPack::scout(Population& wolves, std::size_t i, double step, RandomStream& random) {
  const std::span<const double> place = wolves.at(i);
  for (std::size_t d = 0; d < trial_.size(); ++d) {
    trial_[d] = place[d] + random.uniform(-step, step) * wolves.span(d);
  }
  go_if_better(wolves, i);
}

void WolfPack::besiege(Population& wolves, std::size_t i, double step, RandomStream& random) {
  const std::span<const double> place = wolves.at(i);
  const std::vector<double>& prey = wolves.best().place;
  // Called: some way towards the leader.
  for (std::size_t d = 0; d < trial_.size(); ++d) {
    trial_[d] = place[d] + config_.contraction * random.uniform() * (prey[d] - place[d]);
  }
  go_if_better(wolves, i);
  // Equation 9, its distance taken as it is after the call.
  for (std::size_t d = 0; d < trial_.size(); ++d) {
    trial_[d] = place[d] + random.uniform(-1.0, 1.0) * step * std::abs(prey[d] - place[d]);
  }
  go_if_better(wolves, i);
}

void WolfPack::renew(Population& wolves, RandomStream& random) {
  const auto born = static_cast<std::size_t>(config_.renewal * static_cast<double>(wolves.size()));
  order_.resize(wolves.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  const auto end = order_.begin() + static_cast<std::ptrdiff_t>(born);
  std::ranges::partial_sort(order_, end, [&](std::size_t a, std::size_t b) {
    return wolves.value(a) > wolves.value(b) || (wolves.value(a) == wolves.value(b) && a < b);
  });
  for (auto it = order_.begin(); it != end; ++it) {
    const std::span<double> place = wolves.at(*it);
    for (std::size_t d = 0; d < place.size(); ++d) {
      place[d] = wolves.low(d) + random.uniform() * wolves.span(d);
    }
    wolves.judge(*it);
  }
}

}  // namespace coop::global_planner::swarm
