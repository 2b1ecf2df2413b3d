#include "arm_driver/pick_sequence.hpp"

#include <algorithm>

namespace coop::arm_driver {

using Eigen::Vector3d;
using Phase = PickSequence::Phase;

namespace {

/// Between two steps; the sequence is asked some fifty times a second.
constexpr Duration kLongestStep = std::chrono::milliseconds(100);

}  // namespace

std::string_view to_string(PickSequence::Phase phase) {
  switch (phase) {
    case Phase::kRecover:
      return "recover";
    case Phase::kIdle:
      return "idle";
    case Phase::kApproach:
      return "approach";
    case Phase::kDescend:
      return "descend";
    case Phase::kGrip:
      return "grip";
    case Phase::kBackOff:
      return "back off";
    case Phase::kLift:
      return "lift";
    case Phase::kCarry:
      return "carry";
    case Phase::kLower:
      return "lower";
    case Phase::kRelease:
      return "release";
    case Phase::kHome:
      return "home";
  }
  return "";
}

void PickSequenceConfig::describe(config::Fields& fields) {
  const auto time = [&](std::string_view name, double& value, std::string_view help) {
    fields.number(name, value, {.unit = "s", .help = help, .min = 0, .max = 60});
  };
  time("grip_time", grip_time, "vacuum for so long: the egg is held");
  time("grip_timeout", grip_timeout, "no vacuum for so long: there is no egg here");
  time("release_time", release_time, "stay over the basket");
  time("release_timeout", release_timeout, "an egg that still sticks is given up");
  time("loss_time", loss_time, "no vacuum for so long: the egg fell");
  time("reading_timeout", reading_timeout, "no reading of the vacuum for so long: abort");
  time("arrival_timeout", arrival_timeout, "time to arrive after a motion's end");
  fields.number("arrival_tolerance", arrival_tolerance,
                {.unit = "rad", .help = "of each joint", .min = 1e-4, .max = 0.2});
}

PickSequence::PickSequence(const PickSequenceConfig& config, const ArmMotion& motion,
                           PickRecord record)
    : config_(config), motion_(motion), record_(std::move(record)) {}

bool PickSequence::knows(std::string_view pick_id) const {
  return record_.find(pick_id) != nullptr ||
         (record_.running && record_.running->pick_id == pick_id && phase_ != Phase::kRecover);
}

bool PickSequence::is_motion(Phase phase) const {
  return phase != Phase::kRecover && phase != Phase::kIdle && phase != Phase::kGrip &&
         phase != Phase::kRelease;
}

Vector3d PickSequence::above(const Vector3d& point, double height) const {
  return {point.x(), point.y(), motion_.config().contact_height + height};
}

const ArmOutputs& PickSequence::step(const ArmInputs& inputs, Time now) {
  const bool first = out_.target.size() == 0;
  out_.record_changed = false;
  out_.reports.clear();
  if (first || now < now_) {
    interrupted_ = true;
    since_ = vacuum_known_ = vacuum_changed_ = now;
  }
  if (first) {
    out_.suction = inputs.suction;
    out_.target = inputs.positions;
  } else if (now - now_ > kLongestStep) {
    pass_over(now - now_ - kLongestStep);
  }
  now_ = now;
  positions_ = inputs.positions;
  if (inputs.vacuum != vacuum_) vacuum_changed_ = now;
  if (inputs.vacuum) vacuum_known_ = now;
  vacuum_ = inputs.vacuum;

  if (phase_ == Phase::kRecover) recover(inputs);
  for (const PickOrder& order : inputs.orders) take(order);
  if (inputs.emergency_stop) {
    if (!interrupted_ || first) out_.target = positions_;
    interrupted_ = true;
    since_ = vacuum_known_ = now;
  } else {
    if (interrupted_) enter(phase_);
    run(inputs);
  }
  out_.busy = phase_ != Phase::kIdle || record_.running.has_value();
  return out_;
}

/// The driver did not run (stopped, or its clock jumped ahead): no motion is late for that time.
void PickSequence::pass_over(Duration time) {
  since_ += time;
  vacuum_known_ += time;
  vacuum_changed_ += time;
}

void PickSequence::take(const PickOrder& order) {
  if (const PickReport* known = record_.find(order.pick_id)) {
    out_.reports.push_back(*known);
    return;
  }
  if (!record_.running) {
    start(order);
  } else if (record_.running->pick_id != order.pick_id) {
    out_.reports.push_back({order.pick_id, order.egg_id, PickOutcome::kBusy,
                            "the arm works on " + record_.running->pick_id});
  } else if (phase_ == Phase::kRecover) {
    said_again_ = order;
  }
}

void PickSequence::start(const PickOrder& order) {
  record_.running = RunningPick{order.pick_id, order.egg_id, PickStage::kStarted};
  out_.record_changed = true;
  ending_.reset();
  if (!order.egg_in_base) {
    finish(PickOutcome::kAborted, order.egg_in_base.error());
    return conclude();
  }
  const auto touches = motion_.touches(*order.egg_in_base);
  if (!touches) {
    const bool limit = touches.error() == IkError::kJointLimit;
    finish(limit ? PickOutcome::kJointLimit : PickOutcome::kOutOfReach,
           "the egg is " + std::string(to_string(touches.error())));
    return conclude();
  }
  touches_.assign(touches->rbegin(), touches->rend());
  first_touch_ = true;
  enter(Phase::kApproach);
}

JointTrajectory PickSequence::motion_of(Phase phase) const {
  const ArmMotionConfig& config = motion_.config();
  const Vector3d tip = motion_.tip(positions_);
  switch (phase) {
    case Phase::kApproach: {
      if (!first_touch_) {
        return motion_.straight_to(positions_, above(touches_.back(), config.search_lift));
      }
      const auto goal = motion_.posture_at(above(touches_.back(), config.approach_height));
      return motion_.to(positions_, goal ? *goal : positions_);
    }
    case Phase::kDescend:
      return motion_.straight_to(positions_, touches_.back());
    case Phase::kBackOff:
      return motion_.straight_to(positions_, above(tip, config.search_lift));
    case Phase::kLift:
      return motion_.straight_to(positions_, above(tip, config.lift_height));
    case Phase::kCarry:
      return motion_.to(positions_, motion_.above_basket());
    case Phase::kLower:
      return motion_.to(positions_, motion_.at_basket());
    case Phase::kHome:
      return motion_.to(positions_, motion_.home());
    default:
      return motion_.to(out_.target, out_.target);
  }
}

void PickSequence::enter(Phase phase) {
  phase_ = phase;
  since_ = now_;
  interrupted_ = false;
  trajectory_ = motion_of(phase);
}

bool PickSequence::has_arrived() const {
  return seconds_in_phase() >= trajectory_.duration() &&
         (positions_ - trajectory_.goal()).cwiseAbs().maxCoeff() < config_.arrival_tolerance;
}

void PickSequence::run(const ArmInputs& inputs) {
  watch_held_egg(inputs);
  if (phase_ == Phase::kGrip) grip(inputs);
  if (phase_ == Phase::kRelease) release(inputs);
  if (is_motion(phase_)) {
    if (has_arrived()) {
      arrive();
    } else if (seconds_in_phase() > trajectory_.duration() + config_.arrival_timeout) {
      out_.suction = false;
      if (!ending_) finish(PickOutcome::kAborted, "the arm does not follow");
      conclude();
      out_.target = positions_;
      enter(Phase::kIdle);
    }
  }
  out_.target = trajectory_.at(seconds_in_phase()).positions;
}

void PickSequence::arrive() {
  switch (phase_) {
    case Phase::kApproach:
      return enter(Phase::kDescend);
    case Phase::kDescend:
      out_.suction = true;
      vacuum_changed_ = vacuum_known_ = now_;
      return enter(Phase::kGrip);
    case Phase::kBackOff:
      return enter(Phase::kApproach);
    case Phase::kLift:
      return enter(ending_ ? Phase::kHome : Phase::kCarry);
    case Phase::kCarry:
      return enter(Phase::kLower);
    case Phase::kLower:
      set_stage(PickStage::kReleasing);
      out_.suction = false;
      return enter(Phase::kRelease);
    default:  // kHome
      conclude();
      return enter(Phase::kIdle);
  }
}

void PickSequence::recover(const ArmInputs& inputs) {
  const bool matters = record_.running || inputs.suction;
  if (matters && !inputs.vacuum) return;
  // A reading from before the last command of the earlier life may still be on its way.
  if (matters && to_seconds(now_ - vacuum_changed_) < config_.loss_time) return;
  if (matters && *inputs.vacuum) {
    out_.suction = true;
    if (!record_.running) record_.running = RunningPick{};
    const PickStage stage = record_.running->stage;
    if (stage == PickStage::kStarted) set_stage(PickStage::kHolding);
    const double height = motion_.tip(positions_).z() - motion_.config().contact_height;
    return enter(height < motion_.config().lift_height ? Phase::kLift : Phase::kCarry);
  }
  out_.suction = false;
  if (record_.running && record_.running->stage == PickStage::kReleasing) {
    finish(PickOutcome::kPicked, "released before the driver's restart");
  } else if (record_.running && record_.running->stage == PickStage::kHolding) {
    finish(PickOutcome::kAborted, "the egg was lost while the driver was away");
  } else if (record_.running) {
    // The egg still lies where it lay: as if the order had never come.
    record_.running.reset();
    out_.record_changed = true;
  }
  enter(Phase::kHome);
  if (said_again_) {
    const PickOrder order = *std::exchange(said_again_, std::nullopt);
    take(order);
  }
}

void PickSequence::grip(const ArmInputs& inputs) {
  const double unchanged = to_seconds(now_ - vacuum_changed_);
  if (inputs.vacuum == true && unchanged >= config_.grip_time) {
    set_stage(PickStage::kHolding);
    return enter(Phase::kLift);
  }
  if (inputs.vacuum == false && seconds_in_phase() >= config_.grip_timeout) try_next_touch();
  if (to_seconds(now_ - vacuum_known_) > config_.reading_timeout) {
    finish(PickOutcome::kAborted, "no reading of the vacuum");
    out_.suction = false;
    enter(Phase::kLift);
  }
}

void PickSequence::try_next_touch() {
  out_.suction = false;
  touches_.pop_back();
  first_touch_ = false;
  if (touches_.empty()) {
    finish(PickOutcome::kNoVacuum, "no egg at the place told or around it");
    return enter(Phase::kLift);
  }
  enter(Phase::kBackOff);
}

void PickSequence::watch_held_egg(const ArmInputs& inputs) {
  const bool carrying =
      !ending_ && (phase_ == Phase::kLift || phase_ == Phase::kCarry || phase_ == Phase::kLower);
  if (!carrying || inputs.vacuum != false) return;
  if (to_seconds(now_ - vacuum_changed_) < config_.loss_time) return;
  finish(PickOutcome::kAborted, "the egg fell on the way to the basket");
  out_.suction = false;
  if (phase_ != Phase::kLift) enter(Phase::kHome);
}

void PickSequence::release(const ArmInputs& inputs) {
  out_.suction = false;
  const double waited = seconds_in_phase();
  if (waited < config_.release_time) return;
  if (inputs.vacuum != false && waited < config_.release_timeout) return;
  if (inputs.vacuum == true) {
    finish(PickOutcome::kAborted, "the egg does not come off the cup");
  } else {
    finish(PickOutcome::kPicked, "");
  }
  enter(Phase::kHome);
}

void PickSequence::set_stage(PickStage stage) {
  if (!record_.running) return;
  record_.running->stage = stage;
  out_.record_changed = true;
}

void PickSequence::finish(PickOutcome outcome, std::string detail) {
  if (!record_.running) return;
  ending_ =
      PickReport{record_.running->pick_id, record_.running->egg_id, outcome, std::move(detail)};
}

void PickSequence::conclude() {
  if (!ending_) return;
  if (!ending_->pick_id.empty()) {
    out_.reports.push_back(*ending_);
    record_.add(*ending_);
  }
  ending_.reset();
  record_.running.reset();
  out_.record_changed = true;
}

}  // namespace coop::arm_driver
