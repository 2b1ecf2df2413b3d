#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace coop::slam {

/// Weights that sum to one, proportional to exp(log_weights), safe against under- and overflow.
[[nodiscard]] std::vector<double> normalized_weights(std::span<const double> log_weights);

/// Effective number of particles, 1 / sum of squared weights (Doucet 1998): from 1 (one has all) to
/// the count (all alike).
[[nodiscard]] double effective_count(std::span<const double> weights);

/// Low variance resampling (Thrun, Burgard, Fox: Probabilistic Robotics, table 4.4): for each
/// survivor the index of the particle it copies, ascending. `offset` in [0, 1) is the one random
/// number. A particle of weight w is copied floor(N w) or ceil(N w) times.
[[nodiscard]] std::vector<std::size_t> low_variance_resample(std::span<const double> weights,
                                                             double offset);

}  // namespace coop::slam
