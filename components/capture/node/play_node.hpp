#pragma once
#include <memory>
#include <optional>

#include "capture/node/keyboard.hpp"
#include "capture/node/play_config.hpp"
#include "capture/node/play_output.hpp"
#include "capture/traffic/lockstep_feed.hpp"
#include "capture/traffic/play_schedule.hpp"
#include "rosgraph_msgs/msg/Clock.h"
#include "runtime/node.hpp"

namespace coop::capture {

/// Shell of the player. By the wall clock every message is published at its own deadline; in
/// lockstep it is the master of time: a capture of a lockstep is fed tick by tick as it was, any
/// other one in ticks of `clock_period`.
class PlayNode {
 public:
  using Config = PlayConfig;
  static void check(const Config& config);
  PlayNode(runtime::Node& node, const Config& config);

 private:
  void begin_lockstep();
  Time step();
  void publish_clock(Time time);
  bool publish(const PlayMessage& message);
  void look_for_readers();
  void begin();
  /// Publishes what is due and asks to be called for what is next.
  void work();
  bool publish_due(PlaySchedule::Wall now);
  void call_for_next();
  void handle_keys();
  void step_once();
  void end();

  runtime::Node& node_;
  Config config_;
  PlayList list_;
  std::unique_ptr<PlayOutput> output_;
  runtime::Publisher<rosgraph_msgs::msg::Clock> clock_;
  std::optional<Keyboard> keyboard_;
  PlaySchedule schedule_;
  PlaySchedule::Wall opened_;
  PlaySchedule::Wall matched_{};  ///< since then all readers are matched
  std::optional<PlayMessage> next_;
  Time next_clock_ = Time::max();
  std::optional<LockstepFeed> feed_;
  Time tick_{};
  std::uint64_t published_ = 0;
  std::uint64_t refused_ = 0;
  int stalls_ = 0;
};

}  // namespace coop::capture
