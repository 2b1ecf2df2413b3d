#include "runtime/lockstep/follower.hpp"

#include "conversions/time.hpp"
#include "coop_msgs/msg/LockstepDone.h"
#include "coop_msgs/msg/LockstepJoin.h"

namespace coop::runtime {

using coop_msgs::msg::LockstepDone;
using coop_msgs::msg::LockstepJoin;
using coop_msgs::msg::LockstepMember;
using coop_msgs::msg::LockstepRoster;
using coop_msgs::msg::LockstepTick;
namespace DoneKind = coop_msgs::msg::LockstepDone_Constants;

namespace {

/// A sample that has not come by then was lost for good: its writer had given this reader up.
constexpr auto kLost = std::chrono::seconds(3);

const LockstepMember* find(const LockstepRoster& roster, const std::string& name) {
  for (const LockstepMember& member : roster.members()) {
    if (member.name() == name) return &member;
  }
  return nullptr;
}

}  // namespace

LockstepFollower::LockstepFollower(Executor& executor, Transport& carrier,
                                   LockstepTransport& transport, const std::string& name)
    : executor_(executor),
      transport_(transport),
      name_(name),
      incarnation_(static_cast<std::uint64_t>(to_nanoseconds(SystemClock().now()))) {
  const auto wake = [&executor] { executor.wake(); };
  match_watch_ = carrier.on_match(wake);
  roster_reader_ = carrier.create_reader("lockstep_roster", message_type<LockstepRoster>(),
                                         Qos::kStateLatched, wake);
  join_writer_ =
      carrier.create_writer("lockstep_join", message_type<LockstepJoin>(), Qos::kStateLatched);
  tick_reader_ =
      transport.create_control_reader("lockstep_tick/" + name, message_type<LockstepTick>(), wake);
  done_writer_ = transport.create_control_writer("lockstep_done", message_type<LockstepDone>());
  executor_.add_source(*this);
  executor_.set_round_end([this] { end_tick(); });
  executor_.add_wall_timer(std::chrono::seconds(1), [this] { look_for_losses(); });
}

LockstepFollower::~LockstepFollower() {
  executor_.set_round_end([] {});
  executor_.remove_source(*this);
}

void LockstepFollower::join(Logger& log, std::function<void(Time)> set_time) {
  log_ = &log;
  set_time_ = std::move(set_time);
  if (epoch_ != 0) ask();
}

void LockstepFollower::leave() {
  has_left_ = true;
  report(DoneKind::LEAVING);
  done_writer_->wait_for_acknowledgments(std::chrono::milliseconds(200));
}

void LockstepFollower::ask() {
  LockstepJoin message;
  message.name(name_);
  message.epoch(epoch_);
  message.member(transport_.describe(incarnation_));
  join_writer_->write(&message);
}

bool LockstepFollower::handle_one() {
  if (has_left_ || log_ == nullptr) return false;
  Sample sample;
  if (roster_reader_->take(sample)) {
    receive(*static_cast<const LockstepRoster*>(sample.message.get()));
    return true;
  }
  if (round_ && may_settle()) {
    settle();
    return true;
  }
  if (!order_ && tick_reader_->take(sample)) {
    const auto& tick = *static_cast<const LockstepTick*>(sample.message.get());
    if (tick.epoch() != epoch_ || tick.round() != settled_round_) return true;
    for (const auto& mark : tick.marks()) transport_.expect(mark);
    order_ = tick;
    order_since_ = Wall::now();
  }
  if (order_ && !is_running_ && transport_.collect()) {
    begin_tick();
    return true;
  }
  return false;
}

void LockstepFollower::receive(const LockstepRoster& roster) {
  if (roster.epoch() != epoch_) {
    epoch_ = roster.epoch();
    settled_round_ = 0;
    round_.reset();
    order_.reset();
    ask();
  }
  const LockstepMember* self = find(roster, name_);
  if (self == nullptr) return;
  if (self->incarnation() != incarnation_) {
    // The roster of before this start names the predecessor.
    if (self->incarnation() > incarnation_) {
      log_->error("lockstep: another program of this name has taken this one's place");
    }
    return;
  }
  order_.reset();
  round_ = roster;
}

bool LockstepFollower::may_settle() const {
  return transport_.is_matched(*round_) && (!condition_ || condition_(*round_));
}

void LockstepFollower::settle() {
  if (settled_round_ == 0) {
    const auto time = conversions::from_msg(round_->time());
    log_->info("lockstep: member from tick {} ({:.2f} s) on", round_->tick() + 1,
               time ? to_seconds(*time) : 0.0);
  }
  transport_.adopt(*round_);
  settled_round_ = round_->round();
  round_.reset();
  report(DoneKind::SETTLED);
}

void LockstepFollower::begin_tick() {
  is_running_ = true;
  transport_.release(order_->tick());
  const auto time = conversions::from_msg(order_->time());
  if (time) set_time_(*time);
  for (const std::string& topic : transport_.take_outside_topics()) {
    if (!log_->is_due("outside " + topic, std::chrono::hours(24))) continue;
    log_->warning("lockstep: {} also comes from outside: this run cannot be repeated exactly",
                  topic);
  }
}

void LockstepFollower::end_tick() {
  if (!is_running_) return;
  is_running_ = false;
  report(DoneKind::DONE);
  order_.reset();
  // The next one may be here already.
  executor_.wake();
}

void LockstepFollower::report(std::uint8_t kind) {
  LockstepDone done;
  done.name(name_);
  done.incarnation(incarnation_);
  done.epoch(epoch_);
  done.round(settled_round_);
  done.tick(order_ ? order_->tick() : 0);
  done.kind(kind);
  const Time next = executor_.next_due();
  done.has_next(next != Time::max());
  if (done.has_next()) done.next(conversions::to_msg(next));
  if (kind == DoneKind::DONE) done.marks(transport_.take_published());
  done_writer_->write(&done);
}

void LockstepFollower::look_for_losses() {
  if (!order_ || is_running_ || Wall::now() - order_since_ < kLost) return;
  log_->error("lockstep: lost {}; joins again", transport_.missing());
  transport_.forgo_missing();
  order_.reset();
  ask();
}

}  // namespace coop::runtime
