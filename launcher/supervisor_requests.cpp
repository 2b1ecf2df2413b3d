// Supervisor: what a person asks for, and stopping.
#include <algorithm>
#include <csignal>

#include "core/config/config.hpp"
#include "launcher/supervisor.hpp"

namespace coop::launcher {
namespace {

/// For so long the base must stand before the rest is stopped: a command may be under way to it.
constexpr std::chrono::milliseconds kRest{100};
/// One that has told nothing for so long has died, or hangs.
constexpr std::chrono::milliseconds kBaseSilence{400};

}  // namespace

Result<Supervisor::Slot*> Supervisor::find(const std::string& name) {
  if (shutting_down()) return fail("the system is stopping");
  std::vector<std::string> names;
  for (Slot& slot : slots_) {
    if (slot.planned->name == name) return &slot;
    names.push_back(slot.planned->name);
  }
  const std::string_view near = config::nearest_name(name, names);
  return fail("no component '" + name + "'" +
              (near.empty() ? "" : "; did you mean '" + std::string(near) + "'?"));
}

Result<void> Supervisor::restart(const std::string& name, Instant now) {
  const auto slot = find(name);
  if (!slot) return fail(slot.error());
  (*slot)->failures.clear();
  (*slot)->restarts += 1;
  if ((*slot)->pid == 0) {
    launch(**slot, now);
  } else {
    terminate(**slot, now);
    (*slot)->start_again = true;
  }
  return {};
}

Result<void> Supervisor::stop(const std::string& name, Instant now) {
  const auto slot = find(name);
  if (!slot) return fail(slot.error());
  (*slot)->start_again = false;
  terminate(**slot, now);
  return {};
}

Result<void> Supervisor::start(const std::string& name, Instant now) {
  const auto slot = find(name);
  if (!slot) return fail(slot.error());
  (*slot)->failures.clear();
  if ((*slot)->pid == 0) {
    launch(**slot, now);
  } else if ((*slot)->state == State::kStopping) {
    (*slot)->start_again = true;
  } else {
    return fail(name + " runs already, pid " + std::to_string((*slot)->pid));
  }
  return {};
}

void Supervisor::terminate(Slot& slot, Instant now) {
  if (slot.pid == 0) {
    if (slot.state != State::kFinished && slot.state != State::kFailed)
      slot.state = State::kStopped;
    slot.deadline = Instant::max();
  } else if (slot.state != State::kStopping) {
    slot.state = State::kStopping;
    slot.deadline = now + seconds(slot.planned->stop_timeout);
    host_.signal(slot.pid, SIGTERM);
  }
}

void Supervisor::shut_down(Outcome outcome, Instant now) {
  if (shutting_down()) return;
  outcome_ = std::move(outcome);
  report_("", "stopping: " + outcome_->reason);
  for (Slot& slot : slots_) {
    slot.start_again = false;
    if (slot.pid == 0) terminate(slot, now);
  }
  if (base_ != nullptr && !done()) halt_base(now);
  stop_in_order(now);
}

void Supervisor::halt_base(Instant now) {
  base_->halt();
  halt_began_ = now;
  waits_for_base_ = true;
  (void)base_is_waited_for(now);
}

bool Supervisor::base_is_waited_for(Instant now) {
  const Base::Motion motion = base_->motion();
  if (motion != Base::Motion::kAtRest) rests_since_ = Instant::max();
  if (motion == Base::Motion::kAtRest) rests_since_ = std::min(rests_since_, now);
  const bool rests = rests_since_ != Instant::max() && now - rests_since_ >= kRest;
  const bool is_gone = motion == Base::Motion::kUnknown && now - halt_began_ >= kBaseSilence;
  const bool too_long = now - halt_began_ >= kHaltLimit;
  waits_for_base_ = motion != Base::Motion::kNone && !rests && !is_gone && !too_long;
  if (!waits_for_base_ && motion == Base::Motion::kMoving) {
    report_("", "the base does not come to rest");
  }
  return waits_for_base_;
}

void Supervisor::stop_in_order(Instant now) {
  if (waits_for_base_) return;
  for (std::size_t i = slots_.size(); i-- > 0;) {
    if (slots_[i].pid != 0 && may_stop(i)) terminate(slots_[i], now);
  }
}

bool Supervisor::may_stop(std::size_t index) const {
  return std::ranges::none_of(
      slots_, [index](const Slot& other) { return other.pid != 0 && other.needs.contains(index); });
}

void Supervisor::kill_all() {
  for (const Slot& slot : slots_) {
    if (slot.pid != 0) host_.signal(slot.pid, SIGKILL);
  }
}

}  // namespace coop::launcher
