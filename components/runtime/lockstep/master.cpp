#include "runtime/lockstep/master.hpp"

#include <fmt/ranges.h>

#include "runtime/node.hpp"

namespace coop::runtime {

using coop_msgs::msg::LockstepDone;
using coop_msgs::msg::LockstepJoin;
using coop_msgs::msg::LockstepRoster;
using coop_msgs::msg::LockstepTick;

namespace {

constexpr auto kPatience = std::chrono::seconds(1);

}  // namespace

LockstepMaster::LockstepMaster(Executor& executor, Transport& carrier, LockstepTransport& transport,
                               const std::string& name, std::vector<std::string> members)
    : executor_(executor),
      carrier_(carrier),
      transport_(transport),
      name_(name),
      expected_(std::move(members)) {
  const auto wake = [&executor] { executor.wake(); };
  match_watch_ = carrier.on_match(wake);
  join_reader_ = carrier.create_reader("lockstep_join", message_type<LockstepJoin>(),
                                       Qos::kStateLatched, wake);
  roster_writer_ =
      carrier.create_writer("lockstep_roster", message_type<LockstepRoster>(), Qos::kStateLatched);
  done_reader_ =
      transport.create_control_reader("lockstep_done", message_type<LockstepDone>(), wake);
  executor_.add_source(*this);
  executor_.set_round_end([this] {
    if (steps_) step();
  });
}

LockstepMaster::~LockstepMaster() {
  executor_.set_round_end([] {});
  executor_.remove_source(*this);
}

void LockstepMaster::start(Node& node, const TimeLead& lead) {
  node_ = &node;
  lead_ = lead;
  if (lead_.rate > 0.0) {
    pacing_.emplace(lead_.rate, lead_.period);
    executor_.add_wall_timer(pacing_->period(),
                             [this] { credit_ += pacing_->due(SystemClock().now()); });
  }
  executor_.add_wall_timer(std::chrono::milliseconds(500), [this] { report_waiting(); });
  const auto epoch = static_cast<std::uint64_t>(to_nanoseconds(SystemClock().now()));
  coordinator_.emplace(transport_.describe(epoch), expected_, epoch);
  moved_ = Wall::now();
  announce(coordinator_->roster());
}

void LockstepMaster::announce(const LockstepRoster& roster) {
  roster_writer_->write(&roster);
}

bool LockstepMaster::handle_one() {
  if (!coordinator_ || steps_) return false;
  if (receive()) return true;
  if (coordinator_->wants_round()) {
    announce(coordinator_->begin_round(now_));
    return true;
  }
  if (coordinator_->phase() == LockstepCoordinator::Phase::kSettling) return settle();
  if (finishes_ || !coordinator_->may_step() || (pacing_ && credit_ <= 0)) return false;
  if (!marks_taken_) {
    for (const auto& mark : coordinator_->take_own_marks()) transport_.expect(mark);
    marks_taken_ = true;
  }
  if (!transport_.collect()) return false;
  transport_.release(coordinator_->tick() + 1);
  steps_ = true;
  return true;
}

bool LockstepMaster::finish() {
  finishes_ = true;
  return !coordinator_ || coordinator_->waits_for().empty();
}

bool LockstepMaster::receive() {
  Sample sample;
  if (join_reader_->take(sample)) {
    const auto& join = *static_cast<const LockstepJoin*>(sample.message.get());
    // Before the round in which the member is to settle: it matches this writer then.
    auto& writer = tick_writers_[join.member().name()];
    if (!writer) {
      writer = carrier_.create_writer("lockstep_tick/" + join.member().name(),
                                      message_type<LockstepTick>(), Qos::kEvent);
    }
    coordinator_->receive(join);
    return true;
  }
  if (done_reader_->take(sample)) {
    coordinator_->receive(*static_cast<const LockstepDone*>(sample.message.get()));
    return true;
  }
  return false;
}

bool LockstepMaster::settle() {
  const LockstepRoster& roster = coordinator_->roster();
  if (!coordinator_->is_settled() || !transport_.is_matched(roster)) return false;
  for (const auto& member : roster.members()) {
    if (member.name() == name_) continue;
    for (const auto& endpoint : member.endpoints()) {
      if (endpoint.topic() != "lockstep_tick/" + member.name()) continue;
      if (!tick_writers_[member.name()]->reaches(endpoint.id())) return false;
    }
  }
  transport_.adopt(roster);
  coordinator_->begin_running();
  node_->log().info("lockstep: {} members from tick {} ({:.2f} s) on", roster.members().size(),
                    roster.tick() + 1, to_seconds(now_));
  moved_ = Wall::now();
  return true;
}

void LockstepMaster::step() {
  steps_ = false;
  marks_taken_ = false;
  if (pacing_) --credit_;
  now_ = lead_.step();
  coordinator_->receive_own(transport_.take_published());
  for (const auto& order : coordinator_->begin_tick(now_)) {
    tick_writers_[order.member]->write(&order.tick);
  }
  moved_ = Wall::now();
  if (node_->health() == Health::kDegraded) node_->set_ready();
  executor_.wake();
}

void LockstepMaster::report_waiting() {
  if (Wall::now() - moved_ < kPatience) return;
  const auto names = coordinator_->waits_for();
  if (!names.empty()) {
    node_->set_degraded(fmt::format("lockstep waits for {} at tick {}", fmt::join(names, ", "),
                                    coordinator_->tick()));
  } else if (const std::string missing = transport_.missing(); !missing.empty()) {
    node_->set_degraded("lockstep waits for " + missing);
  }
}

}  // namespace coop::runtime
