#include "capture/traffic/play_schedule.hpp"

#include <cmath>

namespace coop::capture {

void PlaySchedule::start(Time position, Wall now) {
  started_ = true;
  base_log_ = position;
  base_wall_ = now;
}

PlaySchedule::Wall PlaySchedule::due(Time log_time) const {
  if (log_time <= base_log_) return base_wall_;
  if (paused_) return Wall::max();
  if (rate_ == 0.0) return base_wall_;
  const Duration ahead = log_time - base_log_;
  if (rate_ == 1.0) return base_wall_ + ahead;
  return base_wall_ +
         std::chrono::nanoseconds(std::llround(static_cast<double>(ahead.count()) / rate_));
}

bool PlaySchedule::is_due(Time log_time, Wall now) const {
  return started_ && due(log_time) <= now;
}

Time PlaySchedule::position(Wall now) const {
  if (paused_ || rate_ == 0.0 || now <= base_wall_) return base_log_;
  const std::chrono::nanoseconds elapsed = now - base_wall_;
  if (rate_ == 1.0) return base_log_ + elapsed;
  return base_log_ + Duration(std::llround(static_cast<double>(elapsed.count()) * rate_));
}

void PlaySchedule::pause(Wall now) {
  if (paused_) return;
  base_log_ = position(now);
  base_wall_ = now;
  paused_ = true;
}

void PlaySchedule::resume(Wall now) {
  if (!paused_) return;
  base_wall_ = now;
  paused_ = false;
}

void PlaySchedule::move_to(Time log_time) {
  if ((paused_ || rate_ == 0.0) && log_time > base_log_) base_log_ = log_time;
}

}  // namespace coop::capture
