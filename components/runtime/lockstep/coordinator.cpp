#include "runtime/lockstep/coordinator.hpp"

#include <algorithm>

#include "conversions/time.hpp"

namespace coop::runtime {

using coop_msgs::msg::LockstepDone;
using coop_msgs::msg::LockstepEndpoint;
using coop_msgs::msg::LockstepJoin;
using coop_msgs::msg::LockstepMark;
using coop_msgs::msg::LockstepRoster;
using coop_msgs::msg::LockstepTick;
namespace DoneKind = coop_msgs::msg::LockstepDone_Constants;
namespace EndpointKind = coop_msgs::msg::LockstepEndpoint_Constants;

namespace {

void raise(std::vector<LockstepMark>& marks, const LockstepMark& mark) {
  for (LockstepMark& known : marks) {
    if (known.member() != mark.member() || known.endpoint() != mark.endpoint()) continue;
    known.sequence_number(mark.sequence_number());
    return;
  }
  marks.push_back(mark);
}

}  // namespace

LockstepCoordinator::LockstepCoordinator(coop_msgs::msg::LockstepMember master,
                                         std::vector<std::string> expected, std::uint64_t epoch)
    : master_(master.name()), expected_(std::move(expected)) {
  roster_.epoch(epoch);
  joining_.push_back({.info = std::move(master), .pending = {}, .readers_of = {}});
}

LockstepCoordinator::Member* LockstepCoordinator::find(const std::string& name) {
  const auto found = std::ranges::find_if(
      members_, [&](const Member& member) { return member.info.name() == name; });
  return found == members_.end() ? nullptr : &*found;
}

void LockstepCoordinator::receive(const LockstepJoin& join) {
  if (join.epoch() != roster_.epoch()) return;
  const std::string& name = join.member().name();
  // One that comes back will not finish what its predecessor was asked to do.
  if (Member* predecessor = find(name)) predecessor->working = false;
  std::erase(leaving_, name);
  std::erase_if(joining_, [&](const Member& member) { return member.info.name() == name; });
  joining_.push_back({.info = join.member(), .pending = {}, .readers_of = {}});
}

void LockstepCoordinator::receive(const LockstepDone& done) {
  if (done.epoch() != roster_.epoch()) return;
  Member* member = find(done.name());
  if (member == nullptr || member->info.incarnation() != done.incarnation()) {
    if (done.kind() == DoneKind::LEAVING) {
      std::erase_if(joining_, [&](const Member& joining) {
        return joining.info.name() == done.name() &&
               joining.info.incarnation() == done.incarnation();
      });
    }
    return;
  }
  if (done.kind() == DoneKind::LEAVING) {
    member->working = false;
    leaving_.push_back(done.name());
    return;
  }
  if (done.round() != roster_.round()) return;
  const auto next = conversions::from_msg(done.next());
  member->next = done.has_next() && next ? *next : Time::max();
  if (done.kind() == DoneKind::SETTLED) {
    member->settled = true;
    return;
  }
  if (done.tick() != tick_) return;
  route(static_cast<std::size_t>(member - members_.data()), done.marks());
  member->working = false;
}

void LockstepCoordinator::receive_own(const std::vector<LockstepMark>& marks) {
  const Member* master = find(master_);
  if (master != nullptr) route(static_cast<std::size_t>(master - members_.data()), marks);
}

void LockstepCoordinator::route(std::size_t writer, const std::vector<LockstepMark>& marks) {
  Member& member = members_[writer];
  for (LockstepMark mark : marks) {
    if (mark.endpoint() >= member.readers_of.size()) continue;
    mark.member(static_cast<std::uint32_t>(writer));
    member.info.endpoints()[mark.endpoint()].sequence_number(mark.sequence_number());
    for (const ReaderOf& reader : member.readers_of[mark.endpoint()]) {
      raise(members_[reader.member].pending, mark);
      if (!reader.patient) members_[reader.member].has_work = true;
    }
  }
}

bool LockstepCoordinator::is_working() const {
  return std::ranges::any_of(members_, &Member::working);
}

bool LockstepCoordinator::is_gathered() const {
  return std::ranges::all_of(expected_, [this](const std::string& name) {
    return std::ranges::any_of(joining_,
                               [&](const Member& member) { return member.info.name() == name; });
  });
}

bool LockstepCoordinator::wants_round() const {
  if (phase_ == Phase::kGathering) return is_gathered();
  return !is_working() && (!joining_.empty() || !leaving_.empty());
}

const LockstepRoster& LockstepCoordinator::begin_round(Time now) {
  const std::vector<Member> before = std::move(members_);
  members_.clear();
  const auto is_replaced = [this](const Member& member) {
    return std::ranges::find(leaving_, member.info.name()) != leaving_.end() ||
           std::ranges::any_of(joining_, [&](const Member& joining) {
             return joining.info.name() == member.info.name();
           });
  };
  for (const Member& member : before) {
    if (!is_replaced(member)) members_.push_back(member);
  }
  for (Member& member : joining_) members_.push_back(std::move(member));
  joining_.clear();
  leaving_.clear();
  std::ranges::sort(members_, {}, [](const Member& member) { return member.info.name(); });
  // Marks name places of the round before; those of writers that are gone lapse.
  for (Member& member : members_) {
    std::vector<LockstepMark> pending;
    for (LockstepMark mark : member.pending) {
      const auto& writer = before[mark.member()].info;
      const Member* now_at = find(writer.name());
      if (now_at == nullptr || now_at->info.incarnation() != writer.incarnation()) continue;
      mark.member(static_cast<std::uint32_t>(now_at - members_.data()));
      pending.push_back(mark);
    }
    member.pending = std::move(pending);
    member.has_work = !member.pending.empty();
    member.settled = member.info.name() == master_;
    member.working = false;
  }
  find_readers();
  roster_.round(roster_.round() + 1);
  roster_.tick(tick_);
  roster_.time(conversions::to_msg(now));
  roster_.members().clear();
  for (const Member& member : members_) roster_.members().push_back(member.info);
  phase_ = Phase::kSettling;
  return roster_;
}

void LockstepCoordinator::find_readers() {
  for (Member& member : members_) {
    member.readers_of.assign(member.info.endpoints().size(), {});
    for (std::size_t i = 0; i < member.readers_of.size(); ++i) {
      const LockstepEndpoint& endpoint = member.info.endpoints()[i];
      if (endpoint.kind() != EndpointKind::WRITER) continue;
      for (std::size_t other = 0; other < members_.size(); ++other) {
        bool reads = false;
        bool patient = true;
        for (const LockstepEndpoint& reader : members_[other].info.endpoints()) {
          if (reader.kind() != EndpointKind::READER || reader.topic() != endpoint.topic()) continue;
          reads = true;
          patient = patient && reader.patient();
        }
        if (reads) member.readers_of[i].push_back({other, patient});
      }
    }
  }
}

bool LockstepCoordinator::is_settled() const {
  return std::ranges::all_of(members_, &Member::settled);
}

bool LockstepCoordinator::may_step() const {
  return phase_ == Phase::kRunning && !is_working() && !wants_round();
}

std::vector<LockstepMark> LockstepCoordinator::take_own_marks() {
  Member* master = find(master_);
  return master == nullptr ? std::vector<LockstepMark>() : std::exchange(master->pending, {});
}

std::vector<LockstepCoordinator::Order> LockstepCoordinator::begin_tick(Time time) {
  ++tick_;
  std::vector<Order> orders;
  for (Member& member : members_) {
    if (member.info.name() == master_) continue;
    // Without timers, patience would have no end.
    const bool waits = member.next == Time::max() ? member.pending.empty() : !member.has_work;
    if (waits && member.next > time) continue;
    member.has_work = false;
    LockstepTick tick;
    tick.epoch(roster_.epoch());
    tick.round(roster_.round());
    tick.tick(tick_);
    tick.time(conversions::to_msg(time));
    tick.marks(std::move(member.pending));
    member.pending.clear();
    member.working = true;
    orders.push_back({member.info.name(), std::move(tick)});
  }
  return orders;
}

std::vector<std::string> LockstepCoordinator::waits_for() const {
  std::vector<std::string> names;
  if (phase_ == Phase::kGathering) {
    for (const std::string& name : expected_) {
      const bool joined = std::ranges::any_of(
          joining_, [&](const Member& member) { return member.info.name() == name; });
      if (!joined) names.push_back(name);
    }
    return names;
  }
  for (const Member& member : members_) {
    const bool waits = phase_ == Phase::kSettling ? !member.settled : member.working;
    if (waits) names.push_back(member.info.name());
  }
  return names;
}

}  // namespace coop::runtime
