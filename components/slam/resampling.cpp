#include "slam/resampling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coop::slam {

std::vector<double> normalized_weights(std::span<const double> log_weights) {
  std::vector<double> weights(log_weights.size());
  if (weights.empty()) return weights;
  const double largest = *std::ranges::max_element(log_weights);
  std::ranges::transform(log_weights, weights.begin(),
                         [largest](double w) { return std::exp(w - largest); });
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight /= sum;
  return weights;
}

double effective_count(std::span<const double> weights) {
  double squares = 0.0;
  for (const double weight : weights) squares += weight * weight;
  return squares > 0.0 ? 1.0 / squares : 0.0;
}

std::vector<std::size_t> low_variance_resample(std::span<const double> weights, double offset) {
  const std::size_t count = weights.size();
  std::vector<std::size_t> chosen(count);
  const double step = 1.0 / static_cast<double>(count);
  double reached = count > 0 ? weights[0] : 0.0;
  std::size_t source = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double pointer = (static_cast<double>(i) + offset) * step;
    while (pointer >= reached && source + 1 < count) reached += weights[++source];
    chosen[i] = source;
  }
  return chosen;
}

}  // namespace coop::slam
