#pragma once
#include <map>
#include <vector>

#include "capture/traffic/lockstep_script.hpp"
#include "capture/traffic/play_list.hpp"

namespace coop::capture {

/// The messages of a recorded lockstep, tick by tick, in the order in which they were handled.
class LockstepFeed {
 public:
  /// `list` is read from its begin.
  LockstepFeed(PlayList& list, LockstepScript script);

  /// What was there before the first tick.
  [[nodiscard]] const std::vector<PlayMessage>& before() const { return before_; }
  /// Places of the list's channels in the order in which their writers' samples are handled.
  [[nodiscard]] std::vector<std::size_t> channel_order() const;

  struct Tick {
    Time time{};
    std::vector<PlayMessage> messages;
  };
  /// Nothing behind the last. Throws std::runtime_error for a message that comes after its tick.
  [[nodiscard]] std::optional<Tick> next();

 private:
  void read_until(Time log_time);
  void sort(std::vector<PlayMessage>& messages) const;

  PlayList& list_;
  LockstepScript script_;
  std::size_t tick_ = 0;
  std::optional<PlayMessage> ahead_;
  std::map<std::uint64_t, std::vector<PlayMessage>> waiting_;  ///< by tick
  std::vector<PlayMessage> before_;
};

}  // namespace coop::capture
