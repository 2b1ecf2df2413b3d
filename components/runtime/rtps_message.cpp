#include "runtime/rtps_message.hpp"

#include <algorithm>

namespace coop::runtime::wire {
namespace {

constexpr std::array<std::uint8_t, 4> kMagic{'R', 'T', 'P', 'S'};
constexpr std::size_t kName = 8;  // of the sender, in the header
constexpr std::size_t kSubmessageHeader = 4;
constexpr unsigned kLittleEndian = 1;
constexpr unsigned kInlineQos = 2;
constexpr unsigned kDataOrKey = 4 | 8;  // of DATA
/// Fast DDS leaves shorter ones alone.
constexpr std::size_t kShortestData = 24;
/// From behind the field that tells it to the inline QoS: at least the fields of this version.
constexpr std::size_t kToInlineQos = 16;
constexpr std::size_t kToInlineQosOfFrag = 28;
constexpr std::uint16_t kSentinel = 1;
/// Key hash, participant, endpoint: each begins with the name of a participant.
constexpr std::array<std::uint16_t, 3> kNaming{0x0070, 0x0050, 0x005a};
constexpr std::size_t kKeyHash = 16;
/// How a payload says that it is a list of parameters, and in which order their bytes are.
constexpr std::uint8_t kLittleEndianList = 3;
constexpr std::size_t kMostBits = 256;  // of a set of numbers

/// Far more than a writer counts to: a thousand a second for 34 years.
constexpr std::int64_t kMostSequence = std::int64_t{1} << 40;
/// Fast DDS goes through a gap one by one: 15 days of a writer at 50 Hz.
constexpr std::int64_t kLongestGap = std::int64_t{1} << 26;
constexpr std::uint32_t kLargestSample = 1U << 30U;
/// Fast DDS keeps a number of four bytes in the place of each fragment that is missing.
constexpr std::uint16_t kSmallestFragment = 4;

/// Shows `each` parameter of a list that begins at `at` (what it is, its value); answers the place
/// behind the list, nothing where it does not fit.
template <class Each>
std::optional<std::size_t> walk_parameters(const Submessage& in, std::size_t at, const Each& each) {
  for (;;) {
    if (in.body.size() - at < 4) return std::nullopt;
    const std::uint16_t parameter = in.u16(at);
    const std::size_t size = parameter == kSentinel ? std::size_t{0} : in.u16(at + 2);
    at += 4;
    const std::size_t padded = (size + 3) & ~std::size_t{3};
    if (padded > in.body.size() - at) return std::nullopt;
    if (parameter == kSentinel) return at;
    each(parameter, in.body.subspan(at, size));
    at += padded;
  }
}

/// Where the payload begins; nothing where what comes before does not fit.
template <class Each>
std::optional<std::size_t> payload_place(const Submessage& data, std::size_t shortest,
                                         const Each& each) {
  const std::size_t told = data.u16(2);
  const std::size_t at = 4 + told;
  if (told < shortest || at > data.body.size()) return std::nullopt;
  if (!data.has(kInlineQos)) return at;
  return walk_parameters(data, at, each);
}

std::optional<std::size_t> payload_place(const Submessage& data, std::size_t shortest) {
  return payload_place(data, shortest, [](std::uint16_t, Bytes) {});
}

bool is_sequence(std::int64_t number) {
  return number < kMostSequence;
}

bool is_sound_data(const Submessage& data) {
  if (data.body.size() < kShortestData) return true;
  if (!is_sequence(data.sequence_number(12))) return false;
  if (!data.has(kInlineQos | kDataOrKey)) return true;
  const auto payload = payload_place(data, kToInlineQos);
  return payload && (!data.has(kDataOrKey) || *payload < data.body.size());
}

bool is_sound_fragment(const Submessage& data) {
  if (data.body.size() < kShortestData) return true;
  const auto payload = payload_place(data, kToInlineQosOfFrag);
  if (!payload || !is_sequence(data.sequence_number(12))) return false;
  const std::uint64_t first = data.u32(20);
  const std::uint64_t count = data.u16(24);
  const std::uint64_t size = data.u16(26);
  const std::uint64_t sample = data.u32(28);
  if (first < 1 || count < 1 || size < kSmallestFragment || sample < 1) return false;
  if (sample > kLargestSample || (first - 1) * size >= sample) return false;
  if ((first + count - 2) * size >= sample) return false;
  const std::uint64_t told = std::min(count * size, sample - (first - 1) * size);
  return data.body.size() - *payload >= told;
}

/// A set of numbers at `at`, and `more` behind it.
bool holds_set(const Submessage& submessage, std::size_t at, std::size_t more) {
  const std::size_t bits_at = at + 8;
  if (submessage.body.size() < bits_at + 4) return false;
  const std::size_t bits = submessage.u32(bits_at);
  return bits <= kMostBits && submessage.body.size() >= bits_at + 4 + (bits + 31) / 32 * 4 + more &&
         is_sequence(submessage.sequence_number(at));
}

bool is_sound_gap(const Submessage& gap) {
  if (!holds_set(gap, 16, 0)) return false;
  const std::int64_t start = gap.sequence_number(8);
  return start > 0 && gap.sequence_number(16) - start <= kLongestGap;
}

bool is_sound_heartbeat(const Submessage& heartbeat) {
  return heartbeat.body.size() >= 28 && is_sequence(heartbeat.sequence_number(8)) &&
         is_sequence(heartbeat.sequence_number(16));
}

/// Where the two entities of a sub-message stand, the reader's first.
std::optional<std::size_t> entities_place(const Submessage& submessage) {
  std::size_t at = 0;
  switch (submessage.kind) {
    case kData:
    case kDataFrag:
      at = 4;
      break;
    case kAcknack:
    case kHeartbeat:
    case kGap:
    case kNackFrag:
    case kHeartbeatFrag:
      break;
    default:
      return std::nullopt;
  }
  if (submessage.body.size() < at + 8) return std::nullopt;
  return at;
}

std::optional<EntityId> entity(const Submessage& submessage, std::size_t behind) {
  const auto at = entities_place(submessage);
  if (!at) return std::nullopt;
  EntityId id;
  std::copy_n(submessage.body.begin() + static_cast<std::ptrdiff_t>(*at + behind), id.size(),
              id.begin());
  return id;
}

}  // namespace

std::uint16_t Submessage::u16(std::size_t at) const {
  const unsigned first = body[at];
  const unsigned second = body[at + 1];
  return static_cast<std::uint16_t>(has(kLittleEndian) ? first | second << 8U
                                                       : first << 8U | second);
}

std::uint32_t Submessage::u32(std::size_t at) const {
  const std::uint32_t first = u16(at);
  const std::uint32_t second = u16(at + 2);
  return has(kLittleEndian) ? first | second << 16U : first << 16U | second;
}

std::int64_t Submessage::sequence_number(std::size_t at) const {
  return static_cast<std::int64_t>(std::uint64_t{u32(at)} << 32U | u32(at + 4));
}

std::optional<EntityId> Submessage::reader() const {
  return entity(*this, 0);
}

std::optional<EntityId> Submessage::writer() const {
  return entity(*this, 4);
}

bool has_header(Bytes packet) {
  return packet.size() >= kHeader && std::ranges::equal(packet.first(kMagic.size()), kMagic);
}

Prefix sender(Bytes packet) {
  Prefix prefix;
  std::ranges::copy(packet.subspan(kName, prefix.size()), prefix.begin());
  return prefix;
}

std::optional<Submessage> take_submessage(Bytes& rest) {
  if (rest.size() < kSubmessageHeader) return std::nullopt;
  Submessage next{
      .kind = rest[0], .flags = rest[1], .body = rest.first(kSubmessageHeader), .is_last = false};
  std::size_t length = next.u16(2);
  rest = rest.subspan(kSubmessageHeader);
  if (length > rest.size()) return std::nullopt;
  // A length of nothing means: to the end, but for the two that may be empty.
  if (length == 0 && next.kind != kPad && next.kind != kInfoTimestamp) length = rest.size();
  next.body = rest.first(length);
  next.is_last = length == rest.size();
  rest = rest.subspan(std::min((length + 3U) & ~std::size_t{3}, rest.size()));
  return next;
}

std::vector<Prefix> told_of(const Submessage& data) {
  std::vector<Prefix> names;
  const auto add = [&names](Bytes value) {
    if (value.size() < Prefix().size()) return;
    std::ranges::copy(value.first(Prefix().size()), names.emplace_back().begin());
  };
  const auto add_named = [&add](std::uint16_t parameter, Bytes value) {
    if (std::ranges::find(kNaming, parameter) != kNaming.end()) add(value);
  };
  const bool is_fragment = data.kind == kDataFrag;
  if (data.body.size() < kShortestData) return names;
  const auto place =
      payload_place(data, is_fragment ? kToInlineQosOfFrag : kToInlineQos, add_named);
  if (!place) return names;
  const Bytes payload = data.body.subspan(*place);
  if (payload.size() <= kKeyHash) {
    add(payload);  // as it is: where a key is all there is
  } else {
    const Submessage list{
        .kind = data.kind,
        .flags = payload[1] == kLittleEndianList ? std::uint8_t{1} : std::uint8_t{0},
        .body = payload.subspan(4)};
    (void)walk_parameters(list, 0, add_named);
  }
  return names;
}

bool is_sound(const Submessage& submessage) {
  switch (submessage.kind) {
    case kData:
      return is_sound_data(submessage);
    case kDataFrag:
      return is_sound_fragment(submessage);
    case kHeartbeat:
      return is_sound_heartbeat(submessage);
    case kGap:
      return is_sound_gap(submessage);
    case kAcknack:
      return holds_set(submessage, 8, 4);
    default:
      return true;
  }
}

}  // namespace coop::runtime::wire
