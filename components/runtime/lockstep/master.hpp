#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "core/time.hpp"
#include "runtime/executor.hpp"
#include "runtime/lockstep/coordinator.hpp"
#include "runtime/lockstep/lockstep_transport.hpp"
#include "runtime/pacing.hpp"

namespace coop::runtime {

class Node;

/// The master's part in a lockstep. A round of its executor is a tick: once every member has done
/// the tick before and what they wrote is here, the samples are released to the master's own
/// inputs, then the world makes a step, then members get their orders.
class LockstepMaster : public InputSource {
 public:
  /// `members`: without these the first tick does not begin.
  LockstepMaster(Executor& executor, Transport& carrier, LockstepTransport& transport,
                 const std::string& name, std::vector<std::string> members);
  ~LockstepMaster() override;
  LockstepMaster(const LockstepMaster&) = delete;
  LockstepMaster& operator=(const LockstepMaster&) = delete;

  /// After the component was made. `lead`: as given to Node::lead_time().
  void start(Node& node, const TimeLead& lead);
  /// No further step; false as long as members still work on the last one.
  [[nodiscard]] bool finish();

  bool handle_one() override;

 private:
  using Wall = std::chrono::steady_clock;
  void announce(const coop_msgs::msg::LockstepRoster& roster);
  bool receive();
  bool settle();
  void step();
  void report_waiting();

  Executor& executor_;
  Transport& carrier_;
  LockstepTransport& transport_;
  std::string name_;
  std::vector<std::string> expected_;
  std::shared_ptr<void> match_watch_;
  std::unique_ptr<Reader> join_reader_;
  std::unique_ptr<Reader> done_reader_;
  std::unique_ptr<Writer> roster_writer_;
  std::map<std::string, std::unique_ptr<Writer>> tick_writers_;
  Node* node_ = nullptr;
  TimeLead lead_;
  std::optional<Pacing> pacing_;
  std::int64_t credit_ = 0;  ///< steps that are due by the pace
  std::optional<LockstepCoordinator> coordinator_;
  Time now_{};
  bool marks_taken_ = false;  ///< of the step to come
  bool steps_ = false;        ///< in the round that runs
  bool finishes_ = false;
  Wall::time_point moved_;
};

}  // namespace coop::runtime
