#include "dwa/dynamic_window.hpp"

#include <algorithm>

namespace coop::dwa {
namespace {

/// Value `i` of `count` equidistant ones from `low` to `high`; the middle where there is only one.
double sample_of(double low, double high, int i, int count) {
  return count == 1 ? 0.5 * (low + high) : low + (high - low) * i / (count - 1);
}

}  // namespace

DynamicWindow::DynamicWindow(const WindowConfig& config, double acceleration,
                             const vehicle::AckermannGeometry& base, double steering_rate)
    : config_(config),
      acceleration_(acceleration),
      steering_rate_(steering_rate),
      max_steering_(base.max_steering_angle) {}

void DynamicWindow::sample(const MotionState& now, double low, double high, double wish,
                           std::vector<Command>& commands) const {
  const double reach = acceleration_ * config_.window_time;
  const double v_low = std::clamp(low, now.speed - reach, now.speed + reach);
  const double v_high = std::clamp(high, v_low, now.speed + reach);
  const double turn = steering_rate_ * config_.window_time;
  const double steering = std::clamp(now.steering, -max_steering_, max_steering_);
  const double s_low = std::max(-max_steering_, steering - turn);
  const double s_high = std::min(max_steering_, steering + turn);
  const int speeds = v_high > v_low ? config_.speed_samples : 1;
  commands.clear();
  for (int i = 0; i < speeds; ++i) {
    const double v = sample_of(v_low, v_high, i, speeds);
    for (int j = 0; j < config_.steering_samples; ++j) {
      commands.push_back({v, sample_of(s_low, s_high, j, config_.steering_samples)});
    }
    commands.push_back({v, std::clamp(wish, s_low, s_high)});
  }
}

}  // namespace coop::dwa
