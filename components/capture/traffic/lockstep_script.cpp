#include "capture/traffic/lockstep_script.hpp"

#include <algorithm>
#include <stdexcept>

namespace coop::capture {

LockstepScript::LockstepScript(const std::vector<RecordedRoster>& rosters,
                               const std::vector<RecordedOrder>& orders) {
  std::map<std::uint32_t, const RecordedRoster*> by_round;
  for (const RecordedRoster& roster : rosters) {
    if (roster.epoch != rosters.front().epoch) {
      throw std::invalid_argument("the capture holds more than one life of the master of time");
    }
    by_round[roster.round] = &roster;
    for (const auto& member : roster.members) {
      for (std::uint32_t i = 0; i < member.endpoints.size(); ++i) {
        const auto& endpoint = member.endpoints[i];
        if (!endpoint.is_writer) continue;
        writers_.try_emplace(endpoint.id, Writer{.rank = {member.name, i},
                                                 .latched = endpoint.latched,
                                                 .base = endpoint.sequence,
                                                 .ticks = {}});
      }
    }
  }
  std::map<std::uint64_t, Time> times;
  for (const RecordedOrder& order : orders) {
    const auto roster = by_round.find(order.round);
    if (roster == by_round.end() || roster->second->epoch != order.epoch) continue;
    times[order.tick] = order.time;
    for (const auto& mark : order.marks) {
      const auto& members = roster->second->members;
      if (mark.member >= members.size()) continue;
      const auto& endpoints = members[mark.member].endpoints;
      if (mark.endpoint >= endpoints.size()) continue;
      const auto marked = writers_.find(endpoints[mark.endpoint].id);
      if (marked == writers_.end()) continue;  // a reader
      auto& ticks = marked->second.ticks;
      // Several components read it: the first of them counts.
      const auto [entry, is_new] = ticks.try_emplace(mark.sequence, order.tick);
      if (!is_new) entry->second = std::min(entry->second, order.tick);
    }
  }
  for (const auto& [number, time] : times) ticks_.push_back({number, time});
  // A number handled by a tick was handled by it at the latest where a larger one came earlier.
  for (auto& [id, writer] : writers_) {
    std::uint64_t earliest = ~std::uint64_t{0};
    for (auto it = writer.ticks.rbegin(); it != writer.ticks.rend(); ++it) {
      earliest = std::min(earliest, it->second);
      it->second = earliest;
    }
  }
}

std::optional<std::uint64_t> LockstepScript::tick_of(const std::string& writer,
                                                     std::uint64_t sequence) const {
  const auto found = writers_.find(writer);
  if (found == writers_.end()) return std::nullopt;
  if (sequence <= found->second.base) {
    // Of others than latched topics nobody ever saw it.
    return found->second.latched ? std::optional<std::uint64_t>(0) : std::nullopt;
  }
  const auto tick = found->second.ticks.lower_bound(sequence);
  if (tick == found->second.ticks.end()) return std::nullopt;
  return tick->second;
}

std::optional<LockstepScript::Rank> LockstepScript::rank_of(const std::string& writer) const {
  const auto found = writers_.find(writer);
  if (found == writers_.end()) return std::nullopt;
  return found->second.rank;
}

}  // namespace coop::capture
