#pragma once
#include <chrono>

#include "core/time.hpp"

namespace coop::capture {

/// When a recorded moment is due: log time as a function of wall time, with pauses and single
/// steps. Absolute: every deadline is computed from the last start or resumption, so that nothing
/// drifts however late single messages are.
class PlaySchedule {
 public:
  using Wall = std::chrono::steady_clock::time_point;

  /// `rate`: seconds of the capture a second; 0: as fast as possible.
  explicit PlaySchedule(double rate) : rate_(rate) {}

  /// Log time `position` is now.
  void start(Time position, Wall now);
  [[nodiscard]] bool started() const { return started_; }

  [[nodiscard]] bool is_due(Time log_time, Wall now) const;
  /// When it is due; Wall::max() while paused.
  [[nodiscard]] Wall due(Time log_time) const;
  /// The log time reached. As fast as possible: where it was started or moved to last.
  [[nodiscard]] Time position(Wall now) const;

  void pause(Wall now);
  void resume(Wall now);
  [[nodiscard]] bool paused() const { return paused_; }
  /// While paused, or as fast as possible: goes on to this moment. Never back.
  void move_to(Time log_time);

 private:
  double rate_;
  bool started_ = false;
  bool paused_ = false;
  Time base_log_{};
  Wall base_wall_{};
};

}  // namespace coop::capture
