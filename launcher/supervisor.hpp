#pragma once
#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "core/time.hpp"
#include "launcher/base.hpp"
#include "launcher/health.hpp"
#include "launcher/plan.hpp"
#include "launcher/process.hpp"

namespace coop::launcher {

enum class State {
  kWaiting,   ///< for components named in `after`
  kStarting,  ///< the process lives, not ready yet
  kReady,
  kDegraded,    ///< runs, and says what it lacks
  kSilent,      ///< was up; no heartbeat for a second, the process lives
  kBackingOff,  ///< died; will be started again
  kStopping,
  kStopped,   ///< on request
  kFinished,  ///< ended by itself with exit code 0
  kFailed,    ///< given up
};
[[nodiscard]] std::string_view name_of(State state);

/// What the supervisor does to the world; the real one forks, a test's writes down.
class ProcessHost {
 public:
  virtual ~ProcessHost() = default;
  virtual Result<pid_t> start(const PlannedComponent& component) = 0;
  /// To the whole process group of `pid`.
  virtual void signal(pid_t pid, int number) = 0;
  /// The last line the component has printed, or empty.
  [[nodiscard]] virtual std::string last_words(const std::string& component) const = 0;
  /// s of processor that the process wanted so far and others had; nothing where that is not known.
  [[nodiscard]] virtual std::optional<double> starved(pid_t pid) const = 0;
};

/// One component as a person sees it.
struct ComponentView {
  std::string name;
  State state = State::kWaiting;
  pid_t pid = 0;    ///< 0: no process
  Instant since{};  ///< start of the process
  int restarts = 0;
  std::string detail;
};

/// Exit code of the launcher and the reason in one line.
struct Outcome {
  int code = 0;
  std::string reason;
};
inline constexpr int kExitOk = 0;
inline constexpr int kExitBadLaunch = 1;
inline constexpr int kExitGivenUp = 2;
inline constexpr int kExitInUse = 3;
inline constexpr int kExitMissionFailed = 4;
inline constexpr int kExitTimeout = 5;

/// Decides what is started, restarted, killed and stopped, and when. A state machine without clock,
/// threads or system calls: events and the time come in, calls of ProcessHost go out.
///
/// A component is *up* when its heartbeat says ready or degraded (one without heartbeat: as soon as
/// it runs); then those that come `after` it are started. One that is not heard for kSilence is
/// *silent*: it is told, and nothing else happens. One that dies, or stays silent for its
/// heartbeat_timeout, is started again after a pause that doubles with every failure; one that was
/// kept from running by the load of the machine has kPatience times as long. After `give_up_after`
/// failures within `within`, or after exit code 1 (bad configuration) before it ever was up, it is
/// given up, and with a required one the system. Stopping begins with the base: everything else
/// goes on until it stands. Then it goes in reverse order: a component gets SIGTERM when all that
/// come `after` it are gone, and SIGKILL at its stop_timeout.
class Supervisor {
 public:
  using Report = std::function<void(const std::string& component, const std::string& text)>;

  /// The lease of a heartbeat that comes twice a second.
  static constexpr std::chrono::milliseconds kSilence{1000};
  static constexpr double kPatience = 3.0;
  /// A base that does not come to rest in this time is not waited for: from full speed it takes
  /// half of it.
  static constexpr std::chrono::milliseconds kHaltLimit{2000};

  /// Without `base` nothing is known of one, and none is waited for.
  Supervisor(const Plan& plan, ProcessHost& host, Report report, Base* base = nullptr);

  void start(Instant now);
  /// `pid` has been reaped. Pids that are not ours are ignored.
  void on_exit(pid_t pid, const ExitStatus& status, Instant now);
  void on_heartbeat(const Heartbeat& heartbeat, Instant now);
  /// Acts on the deadlines that have passed.
  void tick(Instant now);
  [[nodiscard]] std::optional<Instant> next_deadline() const;

  /// By name, on a person's request; the error is one line.
  Result<void> restart(const std::string& name, Instant now);
  Result<void> stop(const std::string& name, Instant now);
  Result<void> start(const std::string& name, Instant now);
  /// Stops everything. The first outcome stands.
  void shut_down(Outcome outcome, Instant now);
  /// SIGKILL to everything that still lives.
  void kill_all();

  [[nodiscard]] bool shutting_down() const { return outcome_.has_value(); }
  /// Nothing runs and nothing will.
  [[nodiscard]] bool done() const;
  [[nodiscard]] bool all_ready() const;
  /// Up, or not missed: finished, or stopped by hand.
  [[nodiscard]] bool required_are_up() const;
  [[nodiscard]] Outcome outcome() const;
  [[nodiscard]] std::vector<ComponentView> view() const;

 private:
  struct Slot {
    const PlannedComponent* planned = nullptr;
    State state = State::kWaiting;
    pid_t pid = 0;
    Instant started{};
    Instant deadline = Instant::max();
    Instant last_heartbeat{};
    double starved_before = 0.0;  ///< s, when it fell silent
    int restarts = 0;
    bool was_up = false;
    bool start_again = false;      ///< as soon as the process is gone
    bool killed_for_stop = false;  ///< SIGTERM did not help
    std::string doom;              ///< why we have killed it
    std::string detail;
    std::deque<Instant> failures;
    std::set<std::size_t> needs;  ///< what it comes after, directly or through others
  };

  void launch_waiting(Instant now);
  void launch(Slot& slot, Instant now);
  void watch(Slot& slot, Instant now);
  [[nodiscard]] bool lacks_processor(const Slot& slot, Instant now) const;
  void become_up(Slot& slot, State state, const std::string& detail, Instant now);
  void after_failure(Slot& slot, const std::string& what, bool hopeless, Instant now);
  void give_up(Slot& slot, const std::string& why, Instant now);
  void after_clean_exit(Slot& slot, Instant now);
  void terminate(Slot& slot, Instant now);
  void halt_base(Instant now);
  [[nodiscard]] bool base_is_waited_for(Instant now);
  void stop_in_order(Instant now);
  void schedule_restart(Slot& slot, double pause, Instant now);
  void check_finished(Instant now);
  [[nodiscard]] bool may_stop(std::size_t index) const;
  [[nodiscard]] std::string with_last_words(const Slot& slot, const std::string& text) const;
  Result<Slot*> find(const std::string& name);

  ProcessHost& host_;
  Report report_;
  Base* base_;
  Instant halt_began_ = Instant::max();
  Instant rests_since_ = Instant::max();
  bool waits_for_base_ = false;
  std::vector<Slot> slots_;
  std::set<pid_t> own_pids_;  ///< all ever started: a late heartbeat of a dead one is no stranger's
  std::set<std::string> strangers_;
  std::optional<Outcome> outcome_;
  Instant last_tick_{};
};

}  // namespace coop::launcher
