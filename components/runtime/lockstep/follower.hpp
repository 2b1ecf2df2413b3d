#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "coop_msgs/msg/LockstepRoster.h"
#include "coop_msgs/msg/LockstepTick.h"
#include "runtime/executor.hpp"
#include "runtime/lockstep/lockstep_transport.hpp"
#include "runtime/log.hpp"

namespace coop::runtime {

/// A component's part in a lockstep: joins, and runs a tick when the master orders it and all its
/// samples are there. Steers an ordinary executor: made before the component, it is the first of
/// its sources, so that the component's inputs find the tick's samples released and the clock set,
/// and at the end of the round it reports the tick done.
class LockstepFollower : public InputSource {
 public:
  /// `carrier` is the one below `transport`.
  LockstepFollower(Executor& executor, Transport& carrier, LockstepTransport& transport,
                   const std::string& name);
  ~LockstepFollower() override;
  LockstepFollower(const LockstepFollower&) = delete;
  LockstepFollower& operator=(const LockstepFollower&) = delete;

  /// After the component was made: asks to be taken in. `set_time` moves the component's clock.
  void join(Logger& log, std::function<void(Time)> set_time);
  /// A round is settled only when this holds too of its roster.
  void hold_until(std::function<bool(const coop_msgs::msg::LockstepRoster&)> condition) {
    condition_ = std::move(condition);
  }
  /// The component stops: others go on without it.
  void leave();

  bool handle_one() override;

 private:
  void receive(const coop_msgs::msg::LockstepRoster& roster);
  void ask();
  [[nodiscard]] bool may_settle() const;
  void settle();
  void begin_tick();
  void end_tick();
  void report(std::uint8_t kind);
  void look_for_losses();

  using Wall = std::chrono::steady_clock;
  Executor& executor_;
  LockstepTransport& transport_;
  std::string name_;
  std::uint64_t incarnation_;
  std::shared_ptr<void> match_watch_;
  std::unique_ptr<Reader> roster_reader_;
  std::unique_ptr<Reader> tick_reader_;
  std::unique_ptr<Writer> join_writer_;
  std::unique_ptr<Writer> done_writer_;
  Logger* log_ = nullptr;
  std::function<void(Time)> set_time_;
  std::function<bool(const coop_msgs::msg::LockstepRoster&)> condition_;
  std::uint64_t epoch_ = 0;                              ///< of the master last heard; 0: none yet
  std::optional<coop_msgs::msg::LockstepRoster> round_;  ///< announced, not settled
  std::uint32_t settled_round_ = 0;
  std::optional<coop_msgs::msg::LockstepTick> order_;  ///< received, not done
  Wall::time_point order_since_;
  bool is_running_ = false;
  bool has_left_ = false;
};

}  // namespace coop::runtime
