#include "runtime/pacing.hpp"

#include <algorithm>
#include <cmath>

namespace coop::runtime {
namespace {

/// Largest number of ticks made up for at once.
constexpr std::int64_t kMaxBurst = 20;
/// Ticks a call without pacing: long enough to matter, short enough to hear inputs in between.
constexpr int kFreeBurst = 2;

}  // namespace

Duration Pacing::period() const {
  constexpr Duration kShortest = std::chrono::milliseconds(1);
  if (rate_ == 0.0) return Duration{1};
  return std::max(kShortest, seconds(to_seconds(tick_) / rate_));
}

int Pacing::due(Time wall_now) {
  if (rate_ == 0.0) return kFreeBurst;
  if (base_ == Time{}) {
    base_ = wall_now;
    return 0;
  }
  const double elapsed = to_seconds(wall_now - base_) * rate_ / to_seconds(tick_);
  // A timer that fires on the tick must not miss it for a rounding error.
  const auto total = static_cast<std::int64_t>(std::floor(elapsed + 1e-6));
  const std::int64_t behind = total - done_;
  if (behind > kMaxBurst) {
    lost_ += (behind - kMaxBurst) * tick_;
    done_ += behind - kMaxBurst;
  }
  const std::int64_t ticks = std::clamp<std::int64_t>(behind, 0, kMaxBurst);
  done_ += ticks;
  return static_cast<int>(ticks);
}

}  // namespace coop::runtime
