#pragma once
#include <cstddef>
#include <vector>

namespace coop::sweep {

/// An estimate with its 95 % confidence interval.
struct Estimate {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  std::size_t count = 0;  ///< of observations; 0: the rest says nothing
};

/// Share of successes by Wilson's score interval (1927), which holds for shares near 0 and 1 too.
[[nodiscard]] Estimate share_of(std::size_t successes, std::size_t count);

/// Mean with Student's t interval; of one value alone, an interval without bounds.
[[nodiscard]] Estimate mean_of(const std::vector<double>& values);

/// The value that Student's t of so many degrees of freedom stays below with probability
/// `probability`, 0.5 <= probability < 1. degrees >= 1.
[[nodiscard]] double student_quantile(double probability, std::size_t degrees);

}  // namespace coop::sweep
