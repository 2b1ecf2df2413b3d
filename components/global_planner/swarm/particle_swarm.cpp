#include "global_planner/swarm/particle_swarm.hpp"

#include <algorithm>

namespace coop::global_planner::swarm {

void ParticleSwarmConfig::describe(config::Fields& fields) {
  swarm.describe(fields);
  fields.number("first_inertia", first_inertia, {.min = 0, .max = 10});
  fields.number("last_inertia", last_inertia, {.min = 0, .max = 10});
  fields.number("cognitive_rate", cognitive_rate, {.min = 0, .max = 10});
  fields.number("social_rate", social_rate, {.min = 0, .max = 10});
  fields.flag("sees_swarm", sees_swarm, {.help = "false: equation 10 as printed"});
}

Minimum ParticleSwarm::minimise(Objective& objective, RandomStream& random,
                                std::vector<double>* course) {
  Population particles(objective, config_.swarm.population, random);
  const std::size_t dimensions = particles.dimensions();
  std::vector<double> velocities(particles.size() * dimensions, 0.0);
  std::vector<double> own_places(particles.at(0).data(),
                                 particles.at(0).data() + particles.size() * dimensions);
  std::vector<double> own_values = particles.values();
  for (int t = 0; t < config_.swarm.iterations; ++t) {
    const double inertia = config_.first_inertia + (config_.last_inertia - config_.first_inertia) *
                                                       t / config_.swarm.iterations;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const std::span<double> place = particles.at(i);
      const std::span<double> velocity(velocities.data() + i * dimensions, dimensions);
      const std::span<double> own(own_places.data() + i * dimensions, dimensions);
      for (std::size_t d = 0; d < dimensions; ++d) {
        const double leader = config_.sees_swarm ? particles.best().place[d] : own[d];
        velocity[d] = inertia * velocity[d] +
                      config_.cognitive_rate * random.uniform() * (own[d] - place[d]) +
                      config_.social_rate * random.uniform() * (leader - place[d]);
        place[d] += velocity[d];
      }
      particles.judge(i);
      if (particles.value(i) < own_values[i]) {
        own_values[i] = particles.value(i);
        std::ranges::copy(place, own.begin());
      }
    }
    if (course != nullptr) course->push_back(particles.best().value);
  }
  return particles.best();
}

}  // namespace coop::global_planner::swarm
