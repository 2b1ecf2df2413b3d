#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "coop_msgs/msg/LockstepDone.h"
#include "coop_msgs/msg/LockstepJoin.h"
#include "coop_msgs/msg/LockstepRoster.h"
#include "coop_msgs/msg/LockstepTick.h"
#include "core/time.hpp"

namespace coop::runtime {

/// The master's book of a lockstep: who takes part, what every writer has written, who still works
/// on the tick. Conservative time management in the manner of the High Level Architecture's next
/// message request (IEEE 1516): a member is asked to run a tick only when samples for it exist or
/// one of its timers is due, and no tick begins before the one before is done everywhere.
///
/// Pure bookkeeping: messages in, messages out.
class LockstepCoordinator {
 public:
  enum class Phase {
    kGathering,  ///< members that are expected have not joined yet
    kSettling,   ///< a round was announced, its members match their endpoints
    kRunning
  };
  struct Order {
    std::string member;
    coop_msgs::msg::LockstepTick tick;
  };

  /// `expected`: names of those without whom the first tick does not begin. `epoch`: another one
  /// after every start.
  LockstepCoordinator(coop_msgs::msg::LockstepMember master, std::vector<std::string> expected,
                      std::uint64_t epoch);

  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] std::uint64_t tick() const { return tick_; }

  /// Those of other epochs are ignored.
  void receive(const coop_msgs::msg::LockstepJoin& join);
  void receive(const coop_msgs::msg::LockstepDone& done);
  /// What the master itself has written.
  void receive_own(const std::vector<coop_msgs::msg::LockstepMark>& marks);

  /// Whether membership has changed and nobody works on a tick.
  [[nodiscard]] bool wants_round() const;
  /// Announces the next round.
  [[nodiscard]] const coop_msgs::msg::LockstepRoster& begin_round(Time now);
  /// Before the first round: tells members of the master's epoch.
  [[nodiscard]] const coop_msgs::msg::LockstepRoster& roster() const { return roster_; }
  /// The round's members have all settled; the caller looks at the master's own endpoints.
  [[nodiscard]] bool is_settled() const;
  void begin_running() { phase_ = Phase::kRunning; }

  /// Running, nobody works on a tick and no round is wanted.
  [[nodiscard]] bool may_step() const;
  /// What the master itself must have received before the next tick. Empties the list.
  [[nodiscard]] std::vector<coop_msgs::msg::LockstepMark> take_own_marks();
  /// Begins the next tick: orders for those who have something to do in it.
  [[nodiscard]] std::vector<Order> begin_tick(Time time);

  /// Names of those the lockstep waits for, empty when none.
  [[nodiscard]] std::vector<std::string> waits_for() const;

 private:
  struct ReaderOf {
    std::size_t member = 0;
    bool patient = true;
  };
  struct Member {
    coop_msgs::msg::LockstepMember info;
    bool settled = false;
    bool working = false;
    bool has_work = false;  ///< something pending cannot wait
    Time next{};            ///< when its next timer is due
    std::vector<coop_msgs::msg::LockstepMark> pending;
    /// By endpoint: the members that read what it writes.
    std::vector<std::vector<ReaderOf>> readers_of;
  };
  [[nodiscard]] Member* find(const std::string& name);
  [[nodiscard]] bool is_working() const;
  [[nodiscard]] bool is_gathered() const;
  void route(std::size_t writer, const std::vector<coop_msgs::msg::LockstepMark>& marks);
  void find_readers();

  std::string master_;
  std::vector<std::string> expected_;
  std::vector<Member> members_;  ///< by name; places are those of the roster while running
  std::vector<Member> joining_;
  std::vector<std::string> leaving_;
  coop_msgs::msg::LockstepRoster roster_;
  Phase phase_ = Phase::kGathering;
  std::uint64_t tick_ = 0;
};

}  // namespace coop::runtime
