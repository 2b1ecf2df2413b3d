#include "capture/traffic/topic_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace coop::capture {
namespace {

Spread spread_of(const std::vector<double>& values) {
  Spread spread{values.front(), 0.0, values.front(), 0.0};
  for (const double value : values) {
    spread.least = std::min(spread.least, value);
    spread.most = std::max(spread.most, value);
    spread.mean += value / static_cast<double>(values.size());
  }
  double squares = 0.0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  spread.deviation = std::sqrt(squares / static_cast<double>(values.size()));
  return spread;
}

}  // namespace

void TopicStatistics::add(Time arrival, std::size_t bytes, std::optional<Duration> delay) {
  ++messages_;
  arrivals_.push_back({arrival, bytes, delay});
  if (arrivals_.size() > window_) arrivals_.pop_front();
}

std::optional<TopicStatistics::Flow> TopicStatistics::flow() const {
  if (arrivals_.size() < 2) return std::nullopt;
  std::vector<double> periods;
  std::vector<double> sizes;
  double bytes = 0.0;
  for (std::size_t i = 0; i < arrivals_.size(); ++i) {
    sizes.push_back(static_cast<double>(arrivals_[i].bytes));
    if (i == 0) continue;
    periods.push_back(to_seconds(arrivals_[i].time - arrivals_[i - 1].time));
    bytes += sizes.back();
  }
  const double elapsed = to_seconds(arrivals_.back().time - arrivals_.front().time);
  if (elapsed <= 0.0) return std::nullopt;
  return Flow{.rate = static_cast<double>(periods.size()) / elapsed,
              .bytes_per_second = bytes / elapsed,
              .period = spread_of(periods),
              .size = spread_of(sizes),
              .window = arrivals_.size()};
}

std::optional<Spread> TopicStatistics::delay() const {
  std::vector<double> delays;
  for (const Arrival& arrival : arrivals_) {
    if (arrival.delay) delays.push_back(to_seconds(*arrival.delay));
  }
  if (delays.empty()) return std::nullopt;
  return spread_of(delays);
}

}  // namespace coop::capture
