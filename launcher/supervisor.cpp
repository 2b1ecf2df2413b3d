#include "launcher/supervisor.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>

namespace coop::launcher {
namespace {

/// A longer pause between two ticks means that the launcher itself did not run (suspended, stopped,
/// machine asleep): the heartbeats of that time are still to be read and nobody is blamed for them.
constexpr std::chrono::seconds kOwnPause{1};

/// How often it is looked after one that is silent, and after a base that comes to rest.
constexpr std::chrono::milliseconds kSilentLook{100};
constexpr std::chrono::milliseconds kHaltLook{20};

std::string shown(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, seconds < 10 ? "%.2f s" : "%.0f s", seconds);
  return text;
}

double seconds_between(Instant from, Instant to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Also one that was and has fallen silent.
bool is_up(State state) {
  return state == State::kReady || state == State::kDegraded || state == State::kSilent;
}

}  // namespace

std::string_view name_of(State state) {
  switch (state) {
    case State::kWaiting:
      return "waiting";
    case State::kStarting:
      return "starting";
    case State::kReady:
      return "ready";
    case State::kDegraded:
      return "degraded";
    case State::kSilent:
      return "silent";
    case State::kBackingOff:
      return "backing off";
    case State::kStopping:
      return "stopping";
    case State::kStopped:
      return "stopped";
    case State::kFinished:
      return "finished";
    case State::kFailed:
      return "failed";
  }
  return "unknown";
}

Supervisor::Supervisor(const Plan& plan, ProcessHost& host, Report report, Base* base)
    : host_(host), report_(std::move(report)), base_(base) {
  for (const PlannedComponent& component : plan.components) {
    Slot slot;
    slot.planned = &component;
    for (const std::size_t index : component.after) {
      slot.needs.insert(index);
      slot.needs.insert(slots_[index].needs.begin(), slots_[index].needs.end());
    }
    slots_.push_back(std::move(slot));
  }
}

void Supervisor::start(Instant now) {
  last_tick_ = now;
  launch_waiting(now);
}

void Supervisor::launch_waiting(Instant now) {
  const auto lets_others_start = [this](std::size_t index) {
    const Slot& slot = slots_[index];
    return slot.was_up || slot.state == State::kFinished || slot.state == State::kFailed;
  };
  for (Slot& slot : slots_) {
    if (shutting_down()) return;
    if (slot.state != State::kWaiting) continue;
    if (std::ranges::all_of(slot.planned->after, lets_others_start)) launch(slot, now);
  }
}

void Supervisor::launch(Slot& slot, Instant now) {
  slot.start_again = false;
  slot.killed_for_stop = false;
  slot.detail.clear();
  slot.started = now;
  slot.last_heartbeat = now;
  const Result<pid_t> pid = host_.start(*slot.planned);
  if (!pid) {
    after_failure(slot, pid.error(), true, now);
    return;
  }
  slot.pid = *pid;
  own_pids_.insert(*pid);
  slot.state = State::kStarting;
  slot.deadline = now + seconds(slot.planned->start_timeout);
  report_(slot.planned->name, "started, pid " + std::to_string(*pid));
  if (!slot.planned->sends_heartbeat) become_up(slot, State::kReady, "", now);
}

void Supervisor::become_up(Slot& slot, State state, const std::string& detail, Instant now) {
  const State before = slot.state;
  const bool news = before != state || (state == State::kDegraded && slot.detail != detail);
  slot.state = state;
  slot.detail = detail;
  if (news) {
    std::string text = std::string(name_of(state)) + (detail.empty() ? "" : ": " + detail);
    if (before == State::kStarting) text += " after " + shown(seconds_between(slot.started, now));
    report_(slot.planned->name, text);
  }
  if (before != State::kStarting) return;
  slot.deadline = Instant::max();
  slot.was_up = true;
  launch_waiting(now);
}

void Supervisor::on_heartbeat(const Heartbeat& heartbeat, Instant now) {
  const auto found = std::ranges::find_if(
      slots_, [&](const Slot& slot) { return slot.planned->name == heartbeat.component; });
  if (found == slots_.end()) return;
  Slot& slot = *found;
  if (heartbeat.pid != slot.pid) {
    if (!own_pids_.contains(heartbeat.pid) && strangers_.insert(heartbeat.component).second) {
      report_(slot.planned->name, "another one runs on this domain, pid " +
                                      std::to_string(heartbeat.pid) + " on " + heartbeat.host);
    }
    return;
  }
  slot.last_heartbeat = now;
  if (slot.state != State::kStarting && !is_up(slot.state)) return;
  if (heartbeat.health == Health::kReady) {
    become_up(slot, State::kReady, heartbeat.detail, now);
  } else if (heartbeat.health == Health::kDegraded) {
    become_up(slot, State::kDegraded, heartbeat.detail, now);
  } else {
    slot.detail = heartbeat.detail;
  }
}

void Supervisor::on_exit(pid_t pid, const ExitStatus& status, Instant now) {
  const auto found =
      std::ranges::find_if(slots_, [&](const Slot& slot) { return slot.pid == pid && pid != 0; });
  if (found == slots_.end()) return;
  Slot& slot = *found;
  host_.signal(pid, SIGKILL);  // what it has left behind in its group
  slot.pid = 0;
  slot.deadline = Instant::max();
  const std::string doom = std::exchange(slot.doom, "");
  if (slot.state == State::kStopping) {
    report_(slot.planned->name,
            slot.killed_for_stop
                ? "killed: still there " + shown(slot.planned->stop_timeout) + " after SIGTERM"
                : "stopped, " + status.text());
    slot.state = State::kStopped;
    slot.detail.clear();
    if (slot.start_again && !shutting_down()) launch(slot, now);
  } else if (!doom.empty()) {
    after_failure(slot, doom, false, now);
  } else if (status.clean() &&
             (slot.planned->exit_ends_system || slot.planned->restart.policy != "always")) {
    after_clean_exit(slot, now);
  } else {
    after_failure(slot, status.text(), status.code == 1 && !slot.was_up, now);
  }
  if (shutting_down()) stop_in_order(now);
}

void Supervisor::after_clean_exit(Slot& slot, Instant now) {
  slot.state = State::kFinished;
  slot.detail.clear();
  report_(slot.planned->name, "finished");
  if (slot.planned->exit_ends_system) {
    shut_down({kExitOk, slot.planned->name + " has finished"}, now);
    return;
  }
  launch_waiting(now);
  check_finished(now);
}

void Supervisor::after_failure(Slot& slot, const std::string& what, bool hopeless, Instant now) {
  const RestartPolicy& policy = slot.planned->restart;
  slot.failures.push_back(now);
  while (now - slot.failures.front() > seconds(policy.within)) slot.failures.pop_front();
  if (shutting_down()) {
    slot.state = State::kStopped;
    report_(slot.planned->name, what + " while the system stops");
    return;
  }
  const auto count = static_cast<int>(slot.failures.size());
  if (hopeless || policy.policy == "never") {
    give_up(slot, what, now);
  } else if (count >= policy.give_up_after) {
    const double in = seconds_between(slot.failures.front(), now);
    give_up(slot, what + ", failure " + std::to_string(count) + " in " + shown(in), now);
  } else {
    const double doubled = policy.min_backoff * std::pow(2.0, count - 1);
    const double pause = std::min(doubled, policy.max_backoff);
    report_(slot.planned->name, with_last_words(slot, what) + "; started again in " + shown(pause));
    schedule_restart(slot, pause, now);
    slot.detail = what;
  }
}

void Supervisor::schedule_restart(Slot& slot, double pause, Instant now) {
  slot.state = State::kBackingOff;
  slot.restarts += 1;
  slot.deadline = now + seconds(pause);
}

void Supervisor::give_up(Slot& slot, const std::string& why, Instant now) {
  slot.state = State::kFailed;
  slot.detail = why;
  const std::string text = with_last_words(slot, why);
  if (slot.planned->required) {
    shut_down({kExitGivenUp, slot.planned->name + " given up: " + text}, now);
  } else {
    report_(slot.planned->name, "given up: " + text);
    launch_waiting(now);
    check_finished(now);
  }
}

std::string Supervisor::with_last_words(const Slot& slot, const std::string& text) const {
  const std::string words = host_.last_words(slot.planned->name);
  return words.empty() ? text : text + " (last line: " + words + ")";
}

void Supervisor::tick(Instant now) {
  if (now - last_tick_ > kOwnPause) {
    for (Slot& slot : slots_) slot.last_heartbeat += now - last_tick_;
  }
  last_tick_ = now;
  for (Slot& slot : slots_) {
    if (!slot.doom.empty()) continue;
    const bool due = now >= slot.deadline;
    if (slot.state == State::kBackingOff && due) {
      launch(slot, now);
    } else if (slot.state == State::kStopping && due) {
      slot.killed_for_stop = true;
      slot.deadline = Instant::max();
      host_.signal(slot.pid, SIGKILL);
    } else if (slot.state == State::kStarting && due) {
      slot.doom = "not ready within " + shown(slot.planned->start_timeout) +
                  (slot.detail.empty() ? "" : ": " + slot.detail);
    } else if (is_up(slot.state) && slot.planned->sends_heartbeat) {
      watch(slot, now);
    }
    if (!slot.doom.empty()) host_.signal(slot.pid, SIGKILL);
  }
  if (waits_for_base_ && !base_is_waited_for(now)) stop_in_order(now);
}

/// The heartbeat of one that is up.
void Supervisor::watch(Slot& slot, Instant now) {
  const Duration silence = now - slot.last_heartbeat;
  const Duration timeout = seconds(slot.planned->heartbeat_timeout);
  if (slot.state != State::kSilent && silence >= std::min<Duration>(kSilence, timeout)) {
    slot.starved_before = host_.starved(slot.pid).value_or(0.0);
    slot.state = State::kSilent;
    slot.detail = "no heartbeat";
    report_(slot.planned->name, "silent: no heartbeat for " + shown(to_seconds(kSilence)));
  }
  if (silence < timeout) return;
  if (to_seconds(silence) < kPatience * to_seconds(timeout) && lacks_processor(slot, now)) return;
  slot.doom = "hangs: no heartbeat for " + shown(to_seconds(silence));
}

/// Whether it would have run for most of its silence, had it been let.
bool Supervisor::lacks_processor(const Slot& slot, Instant now) const {
  const std::optional<double> starved = host_.starved(slot.pid);
  const double silence = std::max(0.0, seconds_between(slot.last_heartbeat + kSilence, now));
  return starved && *starved - slot.starved_before > 0.5 * silence;
}

std::optional<Instant> Supervisor::next_deadline() const {
  Instant next = Instant::max();
  for (const Slot& slot : slots_) {
    if (!slot.doom.empty()) continue;
    next = std::min(next, slot.deadline);
    if (!is_up(slot.state) || !slot.planned->sends_heartbeat) continue;
    next = std::min(next, slot.state == State::kSilent ? last_tick_ + kSilentLook
                                                       : slot.last_heartbeat + kSilence);
  }
  if (waits_for_base_) next = std::min(next, last_tick_ + kHaltLook);
  if (next == Instant::max()) return std::nullopt;
  return next;
}

void Supervisor::check_finished(Instant now) {
  const bool over = std::ranges::all_of(slots_, [](const Slot& slot) {
    return slot.state == State::kFinished || slot.state == State::kFailed;
  });
  if (over) shut_down({kExitOk, "all components have finished"}, now);
}

bool Supervisor::done() const {
  return shutting_down() &&
         std::ranges::all_of(slots_, [](const Slot& slot) { return slot.pid == 0; });
}

bool Supervisor::all_ready() const {
  return std::ranges::all_of(slots_, [](const Slot& slot) {
    return slot.state == State::kReady || slot.state == State::kFinished;
  });
}

bool Supervisor::required_are_up() const {
  return std::ranges::all_of(slots_, [](const Slot& slot) {
    return !slot.planned->required || is_up(slot.state) || slot.state == State::kFinished ||
           slot.state == State::kStopped;
  });
}

Outcome Supervisor::outcome() const {
  return outcome_.value_or(Outcome{});
}

std::vector<ComponentView> Supervisor::view() const {
  std::vector<ComponentView> rows;
  for (const Slot& slot : slots_) {
    rows.push_back({.name = slot.planned->name,
                    .state = slot.state,
                    .pid = slot.pid,
                    .since = slot.started,
                    .restarts = slot.restarts,
                    .detail = slot.detail});
  }
  return rows;
}

}  // namespace coop::launcher
