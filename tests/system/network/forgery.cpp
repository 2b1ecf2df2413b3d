#include "system/network/forgery.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "runtime/rtps_message.hpp"

namespace coop::test {
namespace {

namespace wire = runtime::wire;

constexpr std::uint32_t kAhead = 1'000'000;
constexpr std::ptrdiff_t kNamePlace = 8;  // place of the sender's, in the header
constexpr std::uint32_t kLate = 0xfffffff0;
constexpr wire::EntityId kAnnouncer{0, 1, 0, 0xc2};
constexpr wire::EntityId kAnnouncement{0, 1, 0, 0xc7};
constexpr wire::EntityId kParticipant{0, 0, 1, 0xc1};
constexpr wire::Prefix kNobody{1, 15, 0xba, 0xdc, 0x0d, 0xe1, 0, 0, 0, 0, 0, 9};

void put(Packet& packet, std::size_t at, std::uint32_t value, bool is_little_endian) {
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t shift = 8 * (is_little_endian ? i : 3 - i);
    packet[at + i] = static_cast<std::uint8_t>(value >> shift);
  }
}

template <class Bytes>
void append(Packet& packet, const Bytes& bytes) {
  packet.insert(packet.end(), bytes.begin(), bytes.end());
}

/// Header as that of `packet`, for one more thing to say.
Packet begin_as(const Packet& packet) {
  return {packet.begin(), packet.begin() + wire::kHeader};
}

/// That what `name` names is disposed of and unregistered: DATA without payload, little endian.
void add_disposal(Packet& packet, const wire::EntityId& reader, const wire::EntityId& writer,
                  std::uint32_t sequence, const wire::Prefix& prefix, const wire::EntityId& name) {
  append(packet, Packet{wire::kData, 3, 20 + 20 + 8 + 4, 0, 0, 0, 16, 0});
  append(packet, reader);
  append(packet, writer);
  packet.resize(packet.size() + 8);
  put(packet, packet.size() - 4, sequence, true);
  append(packet, Packet{0x70, 0, 16, 0});
  append(packet, prefix);
  append(packet, name);
  append(packet, Packet{0x71, 0, 4, 0, 0, 0, 0, 3, 1, 0, 0, 0});
}

/// Overwrites the addresses and the lease of an announcement.
void move_away(Packet& packet, const wire::Submessage& data, std::size_t place) {
  for (std::size_t at = 4 + 16 + 4; at + 4 <= data.body.size();) {
    const unsigned parameter = data.u16(at);
    const std::size_t size = data.u16(at + 2);
    if (parameter == 1 || at + 4 + size > data.body.size()) return;
    const std::size_t value = place + at + 4;
    const bool is_locator = parameter == 0x31 || parameter == 0x32;
    if (is_locator && size == 24) put(packet, value + 20, 0x630200c0, true);  // 192.0.2.99
    if (parameter == 2 && size == 8) {                                        // lease: 0.25 s
      put(packet, value, 0, data.has(1));
      put(packet, value + 4, 0x40000000, data.has(1));
    }
    at += 4 + size;
  }
}

bool is_of_user(const wire::EntityId& id) {
  return (id[3] & 0xc0U) == 0;
}

/// Changes what is of the kind wanted; whether there was something.
bool change(Forgery kind, Packet& packet, const wire::Submessage& part, std::size_t place) {
  const bool little = part.has(1);
  const bool is_heartbeat = part.kind == wire::kHeartbeat;
  switch (kind) {
    case Forgery::kReplay:
      return true;
    case Forgery::kHeartbeatAhead:
    case Forgery::kInfoSource:
      if (!is_heartbeat) return false;
      put(packet, place + 12, part.u32(20) + kAhead, little);
      put(packet, place + 20, part.u32(20) + kAhead, little);
      put(packet, place + 24, part.u32(24) + kAhead, little);
      return true;
    case Forgery::kHeartbeatCount:
      if (is_heartbeat) put(packet, place + 24, kLate, little);
      return is_heartbeat;
    case Forgery::kGapAhead:  // has its numbers where a heartbeat has them, and an empty set
      if (!is_heartbeat) return false;
      packet[place - 4] = wire::kGap;
      put(packet, place + 12, std::max(part.u32(12), 1U), little);
      put(packet, place + 20, part.u32(20) + kAhead, little);
      put(packet, place + 24, 0, little);
      return true;
    case Forgery::kDataAhead:
      if (part.kind != wire::kData || !is_of_user(part.writer().value())) return false;
      put(packet, place + 16, part.u32(16) + kAhead, little);
      return true;
    case Forgery::kAcknackCount:
      if (part.kind != wire::kAcknack) return false;
      put(packet, place + part.body.size() - 4, kLate, little);
      return true;
    case Forgery::kMove:
    case Forgery::kTellMoved:
      if (part.kind != wire::kData || part.writer() != kAnnouncer) return false;
      move_away(packet, part, place);
      return true;
    default:
      return false;
  }
}

std::optional<Packet> changed(Forgery kind, const Packet& genuine) {
  Packet packet = genuine;
  bool is_changed = false;
  for (wire::Bytes rest = wire::Bytes(genuine).subspan(wire::kHeader); !rest.empty();) {
    const auto part = wire::take_submessage(rest);
    if (!part || !wire::is_sound(*part)) return std::nullopt;
    const auto place = static_cast<std::size_t>(part->body.data() - genuine.data());
    is_changed = change(kind, packet, *part, place) || is_changed;
  }
  if (!is_changed) return std::nullopt;
  return packet;
}

/// The same by a stranger, with a word for whom he speaks.
Packet by_stranger(const Packet& packet) {
  Packet out = begin_as(packet);
  std::ranges::copy(kNobody, out.begin() + kNamePlace);
  append(out, Packet{wire::kInfoSource, 1, 20, 0, 0, 0, 0, 0, 2, 2, 1, 15});
  append(out, wire::sender(packet));
  out.insert(out.end(), packet.begin() + wire::kHeader, packet.end());
  return out;
}

/// Who sent something: a packet of his, his endpoints, how far his announcements of them are.
struct Known {
  Packet packet;
  std::set<wire::EntityId> endpoints;
  std::map<wire::EntityId, std::uint32_t> announced;
};

std::map<wire::Prefix, Known> all_known(const std::vector<Packet>& genuine) {
  std::map<wire::Prefix, Known> all;
  for (const Packet& packet : genuine) {
    Known& known = all[wire::sender(packet)];
    known.packet = packet;
    for (wire::Bytes rest = wire::Bytes(packet).subspan(wire::kHeader); !rest.empty();) {
      const auto part = wire::take_submessage(rest);
      if (!part) break;
      const bool is_acknack = part->kind == wire::kAcknack;
      const auto own = is_acknack ? part->reader() : part->writer();
      if (!own) continue;
      if (is_of_user(*own)) known.endpoints.insert(*own);
      const bool announces = (*own)[0] == 0 && (*own)[1] == 0 && (*own)[3] == 0xc2;
      if (!announces || !wire::is_sound(*part)) continue;
      std::uint32_t& last = known.announced[*own];
      if (part->kind == wire::kHeartbeat) last = std::max(last, part->u32(20));
      if (part->kind == wire::kData) last = std::max(last, part->u32(16));
    }
  }
  return all;
}

std::vector<Packet> leave(const std::vector<Packet>& genuine, bool only_endpoints) {
  std::vector<Packet> out;
  for (const auto& [prefix, known] : all_known(genuine)) {
    if (!only_endpoints) {
      out.push_back(begin_as(known.packet));
      add_disposal(out.back(), kAnnouncement, kAnnouncer, 2, prefix, kParticipant);
      continue;
    }
    for (const auto& [writer, last] : known.announced) {
      wire::EntityId reader = writer;
      reader[3] = 0xc7;
      std::uint32_t sequence = last;
      for (const wire::EntityId& endpoint : known.endpoints) {
        out.push_back(begin_as(known.packet));
        add_disposal(out.back(), reader, writer, ++sequence, prefix, endpoint);
      }
    }
  }
  return out;
}

/// Fast DDS numbers endpoints from one; those it makes for itself have names everybody knows.
std::vector<wire::EntityId> likely_writers() {
  std::vector<wire::EntityId> writers{{0, 0, 3, 0xc2},    {0, 0, 4, 0xc2},    {0, 2, 0, 0xc2},
                                      {0xff, 0, 3, 0xc2}, {0xff, 0, 4, 0xc2}, {0xff, 2, 0, 0xc2},
                                      {0xff, 2, 2, 0xc3}};
  for (std::uint8_t number = 1; number <= 16; ++number) {
    writers.push_back({0, 0, number, 2});
    writers.push_back({0, 0, number, 3});
  }
  return writers;
}

/// To whichever readers there are.
std::vector<Packet> guess(const std::vector<Packet>& genuine) {
  std::vector<Packet> out;
  for (const auto& [prefix, known] : all_known(genuine)) {
    for (const wire::EntityId& writer : likely_writers()) {
      Packet& packet = out.emplace_back(begin_as(known.packet));
      append(packet, Packet{wire::kGap, 1, 28, 0, 0, 0, 0, 0});
      append(packet, writer);
      packet.resize(packet.size() + 20);
      put(packet, packet.size() - 16, 1, true);
      put(packet, packet.size() - 8, kAhead, true);
    }
  }
  return out;
}

}  // namespace

const std::vector<NamedForgery>& forgeries() {
  static const std::vector<NamedForgery> all{
      {"replay", Forgery::kReplay},
      {"heartbeat_ahead", Forgery::kHeartbeatAhead},
      {"heartbeat_count", Forgery::kHeartbeatCount},
      {"gap_ahead", Forgery::kGapAhead},
      {"data_ahead", Forgery::kDataAhead},
      {"acknack_count", Forgery::kAcknackCount},
      {"leave", Forgery::kLeave},
      {"move", Forgery::kMove},
      {"endpoints_leave", Forgery::kEndpointsLeave},
      {"info_source", Forgery::kInfoSource},
      {"tell_moved", Forgery::kTellMoved},
      {"guess", Forgery::kGuess},
  };
  return all;
}

std::vector<Packet> forge(Forgery kind, const std::vector<Packet>& genuine) {
  if (kind == Forgery::kLeave) return leave(genuine, false);
  if (kind == Forgery::kEndpointsLeave) return leave(genuine, true);
  if (kind == Forgery::kGuess) return guess(genuine);
  std::vector<Packet> out;
  for (const Packet& packet : genuine) {
    auto forged = changed(kind, packet);
    if (!forged) continue;
    if (kind == Forgery::kInfoSource) forged = by_stranger(*forged);
    if (kind == Forgery::kTellMoved) std::ranges::copy(kNobody, forged->begin() + kNamePlace);
    out.push_back(std::move(*forged));
  }
  return out;
}

}  // namespace coop::test
