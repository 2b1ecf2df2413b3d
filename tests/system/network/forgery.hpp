#pragma once
#include <string>
#include <vector>

#include "system/network/garbage.hpp"

namespace coop::test {

/// What one can say in somebody else's name.
enum class Forgery {
  kReplay,          ///< what it has said already
  kHeartbeatAhead,  ///< that a writer is a million samples further, and has none before
  kHeartbeatCount,  ///< a heartbeat so late that all later ones are old
  kGapAhead,        ///< that the next million samples do not matter
  kDataAhead,       ///< the sample after the next million
  kAcknackCount,    ///< an acknowledgement so late that all later ones are old
  kLeave,           ///< that it leaves
  kMove,            ///< that it listens elsewhere and is to be forgotten soon
  kEndpointsLeave,  ///< that its readers and writers are gone
  kInfoSource,      ///< kHeartbeatAhead, in a packet of a stranger who speaks for it
  kTellMoved,       ///< kMove, said by a stranger of it
  kGuess,           ///< kGapAhead, of the writers anybody has: also where packets are encrypted
};

struct NamedForgery {
  std::string name;
  Forgery kind;
};
[[nodiscard]] const std::vector<NamedForgery>& forgeries();

/// Packets of that kind in the names of those who sent the genuine ones.
[[nodiscard]] std::vector<Packet> forge(Forgery kind, const std::vector<Packet>& genuine);

}  // namespace coop::test
