#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// What of an RTPS message (OMG DDSI-RTPS 2.5, 8.3 and 9.4) the guard in front of Fast DDS reads.
namespace coop::runtime::wire {

using Bytes = std::span<const std::uint8_t>;
using Prefix = std::array<std::uint8_t, 12>;
using EntityId = std::array<std::uint8_t, 4>;

enum Kind : std::uint8_t {
  kPad = 0x01,
  kAcknack = 0x06,
  kHeartbeat = 0x07,
  kGap = 0x08,
  kInfoTimestamp = 0x09,
  kInfoSource = 0x0c,
  kInfoDestination = 0x0e,
  kNackFrag = 0x12,
  kHeartbeatFrag = 0x13,
  kData = 0x15,
  kDataFrag = 0x16,
  kSecureBody = 0x30,
  kSecurePrefix = 0x31,
  kSecurePostfix = 0x32,
  kSecureMessage = 0x33,  ///< the message as a whole is signed or encrypted
  kStatistics = 0x80,     ///< Fast DDS's own
};

inline constexpr std::size_t kHeader = 20;

struct Submessage {
  std::uint8_t kind = 0;
  std::uint8_t flags = 0;
  Bytes body;
  bool is_last = false;

  [[nodiscard]] bool has(unsigned flag) const { return (flags & flag) != 0; }
  /// Numbers in its body; `at` and what follows must lie within.
  [[nodiscard]] std::uint16_t u16(std::size_t at) const;
  [[nodiscard]] std::uint32_t u32(std::size_t at) const;
  [[nodiscard]] std::int64_t sequence_number(std::size_t at) const;
  /// Where it is of a kind that goes between endpoints, and long enough.
  [[nodiscard]] std::optional<EntityId> reader() const;
  [[nodiscard]] std::optional<EntityId> writer() const;
};

/// Whether there is a header of an RTPS message.
[[nodiscard]] bool has_header(Bytes packet);
/// In whose name a message with a header is.
[[nodiscard]] Prefix sender(Bytes packet);
/// Takes the next off what is left of a packet; nothing where it reaches beyond.
[[nodiscard]] std::optional<Submessage> take_submessage(Bytes& rest);

/// Of which participants a sub-message of discovery (DATA, DATA_FRAG) tells.
[[nodiscard]] std::vector<Prefix> told_of(const Submessage& data);

/// Whether what the fields of a sub-message say of its own contents is so, and its sequence numbers
/// are such as counting from one can reach. Fast DDS 2.9.1 believes them all.
[[nodiscard]] bool is_sound(const Submessage& submessage);

}  // namespace coop::runtime::wire
