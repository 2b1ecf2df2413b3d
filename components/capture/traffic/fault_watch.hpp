#pragma once
#include <map>
#include <optional>
#include <string>

namespace coop::capture {

/// Tells from heartbeats when something went wrong that a capture should be kept of: a component
/// that was at work (ready for kAtWork heartbeats) degrades, or disappears without having said
/// goodbye. Emergency stops too.
class FaultWatch {
 public:
  /// Programs that start are ready for a while, until they find that inputs are missing: 10 s.
  static constexpr int kAtWork = 20;
  enum class State { kStarting, kReady, kDegraded, kStopping, kFinished };

  /// A heartbeat of `component`; answers what happened, for people, where it is a fault.
  std::optional<std::string> heartbeat(const std::string& component, State state,
                                       const std::string& detail);
  /// The writer of its heartbeats is gone.
  std::optional<std::string> gone(const std::string& component);
  /// The state of one source of emergency stops.
  std::optional<std::string> emergency_stop(const std::string& source, bool engaged,
                                            const std::string& reason);

 private:
  struct Known {
    State state = State::kStarting;
    int ready_beats = 0;
  };
  std::map<std::string, Known> known_;
  std::map<std::string, bool> engaged_;
};

}  // namespace coop::capture
