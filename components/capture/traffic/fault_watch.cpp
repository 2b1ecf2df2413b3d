#include "capture/traffic/fault_watch.hpp"

namespace coop::capture {

std::optional<std::string> FaultWatch::heartbeat(const std::string& component, State state,
                                                 const std::string& detail) {
  Known& known = known_[component];
  const bool was_at_work = known.ready_beats >= kAtWork;
  known.state = state;
  known.ready_beats = state == State::kReady ? known.ready_beats + 1 : 0;
  if (!was_at_work || state != State::kDegraded) return std::nullopt;
  return component + " degraded: " + detail;
}

std::optional<std::string> FaultWatch::gone(const std::string& component) {
  const auto entry = known_.find(component);
  if (entry == known_.end()) return std::nullopt;
  const State last = entry->second.state;
  known_.erase(entry);
  if (last == State::kStopping || last == State::kFinished) return std::nullopt;
  return component + " died";
}

std::optional<std::string> FaultWatch::emergency_stop(const std::string& source, bool engaged,
                                                      const std::string& reason) {
  bool& known = engaged_[source];
  const bool is_new = engaged && !known;
  known = engaged;
  if (!is_new) return std::nullopt;
  return "emergency stop by " + source + (reason.empty() ? "" : ": " + reason);
}

}  // namespace coop::capture
