#pragma once
#include <iosfwd>

#include "experiments/chaos/chaos.hpp"
#include "experiments/chaos/ground.hpp"
#include "experiments/chaos/observer.hpp"
#include "system/support/running_system.hpp"

namespace coop::chaos {

/// One mission of the whole robot, with faults while it lasts.
class MissionRun {
 public:
  MissionRun(const ChaosOptions& options, const Ground& ground, int number, std::ostream& log);

  /// Lets faults of `plan` happen until `left` is 0 or the mission is over; waits for its end.
  void run(FaultPlan& plan, int& left);

  [[nodiscard]] const std::vector<Incident>& incidents() const { return incidents_; }
  [[nodiscard]] const std::vector<std::string>& wrong() const { return wrong_; }
  [[nodiscard]] const std::string& summary() const { return summary_; }
  [[nodiscard]] double simulated() const { return observer_.simulated(); }

 private:
  using Condition = std::function<bool()>;
  /// Looks until the condition holds; false after `limit` s of wall time, or when nothing can come.
  bool look_until(const Condition& condition, double limit);
  bool wait_for_gap(double gap);
  void happen(Fault fault);
  void begin(const Fault& fault, pid_t pid);
  void keep_up(const Fault& fault, pid_t pid, double elapsed) const;
  void end(const Fault& fault, pid_t pid);
  void ask();
  /// s of simulated time: what the observer hears is late by some 20 ms.
  [[nodiscard]] double clock_error() const { return 0.02 * options_.rate; }
  void notice(Incident& incident, pid_t pid, Wall::time_point begin);
  [[nodiscard]] bool all_well(Wall::time_point since);
  [[nodiscard]] bool component_is_back(const Incident& incident, pid_t pid, Wall::time_point begin,
                                       Wall::time_point over);
  void judge(Incident& incident, double lost, double found);
  void check_world(const std::string& after);
  void finish();
  void complain(const std::string& what);

  const ChaosOptions& options_;
  const Ground& ground_;
  int number_;
  std::ostream& log_;
  test::RunningSystem system_;
  Observer observer_;
  std::vector<std::string> names_;
  std::vector<Incident> incidents_;
  std::vector<std::string> wrong_;
  std::string summary_;
  std::uint32_t collisions_ = 0;
  std::optional<launcher::SystemView> view_;  ///< as the launcher told it at asked_
  Wall::time_point asked_{};
  std::string hit_;  ///< whom the fault meets, with what pid
  pid_t hit_pid_ = 0;
  /// s of simulated time when the launcher had started a successor: from then on it may be at work.
  std::optional<double> replaced_;
};

}  // namespace coop::chaos
