#include "sweep/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace coop::sweep {
namespace {

constexpr double kNormal975 = 1.959963984540054;  ///< 97.5 % quantile of the normal distribution

/// P(T <= t) for t >= 0: finite sums of Abramowitz and Stegun 26.7.3 and 26.7.4.
double student_probability(double t, std::size_t degrees) {
  const double angle = std::atan(t / std::sqrt(static_cast<double>(degrees)));
  const double c2 = std::cos(angle) * std::cos(angle);
  const bool odd = degrees % 2 == 1;
  double term = odd ? std::cos(angle) : 1.0;
  double sum = odd && degrees == 1 ? 0.0 : term;
  for (std::size_t k = odd ? 3 : 2; k + 2 <= degrees; k += 2) {
    term *= c2 * static_cast<double>(k - 1) / static_cast<double>(k);
    sum += term;
  }
  const double within =
      odd ? 2.0 / std::numbers::pi * (angle + std::sin(angle) * sum) : std::sin(angle) * sum;
  return 0.5 + 0.5 * within;
}

}  // namespace

double student_quantile(double probability, std::size_t degrees) {
  double low = 0.0;
  double high = 1.0;
  while (student_probability(high, degrees) < probability && high < 1e12) high *= 2.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (student_probability(middle, degrees) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Estimate share_of(std::size_t successes, std::size_t count) {
  if (count == 0) return {};
  const double n = static_cast<double>(count);
  const double p = static_cast<double>(successes) / n;
  const double z2 = kNormal975 * kNormal975;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half =
      kNormal975 / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half), count};
}

Estimate mean_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  const double n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() == 1) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {mean, -kInfinity, kInfinity, 1};
  }
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double half =
      student_quantile(0.975, values.size() - 1) * std::sqrt(squares / (n - 1.0) / n);
  return {mean, mean - half, mean + half, values.size()};
}

}  // namespace coop::sweep
