#pragma once
#include <cstdint>
#include <optional>

#include "core/config/fields.hpp"
#include "core/time.hpp"

namespace coop::chassis_driver {

struct PlaybackConfig {
  double rate = 1.0;      ///< seconds of the log a second; 0: as fast as its readers follow
  double start = 0.0;     ///< s into the log
  double duration = 0.0;  ///< s of the log; 0: to its end

  void describe(config::Fields& fields);
};

/// How far a log is played: log time as a function of wall time, in steps of at most kStep. The
/// owner publishes a step whole and then advances to it; a step that could not be published is
/// asked for again, and what that took is not made up for by hurrying.
class Playback {
 public:
  static constexpr Duration kStep = std::chrono::milliseconds(100);

  /// Of what lies between the stamps `begin` and `end`.
  Playback(const PlaybackConfig& config, Time begin, Time end);

  /// Before the first next(): goes on from a position an earlier life had come to, which is the
  /// first to be played then.
  void resume(Time position);

  [[nodiscard]] Time begin() const { return begin_; }
  [[nodiscard]] Time end() const { return end_; }
  [[nodiscard]] bool started() const { return position_.has_value(); }
  [[nodiscard]] bool at_end() const { return position_ && *position_ >= end_; }

  /// The log time up to which to publish at wall time `now`, or nothing while none is due. The
  /// first call starts a paced playback.
  [[nodiscard]] std::optional<Time> next(Time now);
  void advance(Time to) { position_ = to; }

 private:
  double rate_;
  Time begin_;
  Time end_;
  std::optional<Time> position_;
  Time wall_base_{};
  Time log_base_{};
};

}  // namespace coop::chassis_driver
