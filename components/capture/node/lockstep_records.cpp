#include "capture/node/lockstep_records.hpp"

#include "conversions/time.hpp"
#include "coop_msgs/msg/LockstepRoster.h"
#include "coop_msgs/msg/LockstepTick.h"
#include "runtime/raw_message.hpp"

namespace coop::capture {

std::vector<RecordedRoster> recorded_rosters(PlayList& list) {
  std::vector<RecordedRoster> rosters;
  for (const PlayMessage& message : list.all_of("/lockstep_roster")) {
    coop_msgs::msg::LockstepRoster roster;
    if (!runtime::from_wire(message.bytes, roster)) continue;
    RecordedRoster& recorded = rosters.emplace_back();
    recorded.epoch = roster.epoch();
    recorded.round = roster.round();
    for (const auto& member : roster.members()) {
      auto& copy = recorded.members.emplace_back();
      copy.name = member.name();
      for (const auto& endpoint : member.endpoints()) {
        copy.endpoints.push_back(
            {.id = endpoint.id(),
             .is_writer = endpoint.kind() == coop_msgs::msg::LockstepEndpoint_Constants::WRITER,
             .latched = endpoint.latched(),
             .sequence = endpoint.sequence_number()});
      }
    }
  }
  return rosters;
}

std::vector<RecordedOrder> recorded_orders(PlayList& list) {
  std::vector<RecordedOrder> orders;
  for (const PlayMessage& message : list.all_of("/lockstep_tick/*")) {
    coop_msgs::msg::LockstepTick tick;
    if (!runtime::from_wire(message.bytes, tick)) continue;
    const auto time = conversions::from_msg(tick.time());
    if (!time) continue;
    RecordedOrder& order = orders.emplace_back();
    order.epoch = tick.epoch();
    order.round = tick.round();
    order.tick = tick.tick();
    order.time = *time;
    for (const auto& mark : tick.marks()) {
      order.marks.push_back({mark.member(), mark.endpoint(), mark.sequence_number()});
    }
  }
  return orders;
}

}  // namespace coop::capture
