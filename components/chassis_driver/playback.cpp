#include "chassis_driver/playback.hpp"

#include <algorithm>

namespace coop::chassis_driver {
namespace {

/// A playback farther behind than this, in wall time, goes on from where it is.
constexpr double kForgivenLag = 0.5;  ///< s

}  // namespace

void PlaybackConfig::describe(config::Fields& fields) {
  fields.number("rate", rate,
                {.unit = "s/s",
                 .help = "seconds of the log a second; 0: as fast as readers follow",
                 .min = 0,
                 .max = 10000});
  fields.number("start", start, {.unit = "s", .help = "into the log", .min = 0});
  fields.number("duration", duration,
                {.unit = "s", .help = "of the log to play; 0: to its end", .min = 0});
}

Playback::Playback(const PlaybackConfig& config, Time begin, Time end)
    : rate_(config.rate), begin_(std::min(begin + seconds(config.start), end)), end_(end) {
  if (config.duration > 0.0) end_ = std::min(end, begin_ + seconds(config.duration));
}

void Playback::resume(Time position) {
  begin_ = std::clamp(position, begin_, end_);
}

std::optional<Time> Playback::next(Time now) {
  if (!position_) {
    wall_base_ = now;
    log_base_ = begin_;
    return begin_;
  }
  if (at_end()) return std::nullopt;
  const Time furthest = std::min(*position_ + kStep, end_);
  if (rate_ == 0.0) return furthest;
  Time due = log_base_ + seconds(to_seconds(now - wall_base_) * rate_);
  if (due - *position_ > kStep + seconds(kForgivenLag * rate_)) {
    wall_base_ = now;
    log_base_ = *position_;
    due = log_base_;
  }
  const Time step = std::min(due, furthest);
  if (step <= *position_) return std::nullopt;
  return step;
}

}  // namespace coop::chassis_driver
