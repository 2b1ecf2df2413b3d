#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"

namespace coop::capture {

/// A roster of the lockstep as recorded: who wrote what.
struct RecordedRoster {
  struct Endpoint {
    std::string id;
    bool is_writer = false;
    bool latched = false;
    std::uint64_t sequence = 0;  ///< of the last sample written before the round
  };
  struct Member {
    std::string name;
    std::vector<Endpoint> endpoints;
  };
  std::uint64_t epoch = 0;
  std::uint32_t round = 0;
  std::vector<Member> members;
};

/// An order to run a tick: what the component had to have received.
struct RecordedOrder {
  struct Mark {
    std::uint32_t member = 0;
    std::uint32_t endpoint = 0;
    std::uint64_t sequence = 0;
  };
  std::uint64_t epoch = 0;
  std::uint32_t round = 0;
  std::uint64_t tick = 0;
  Time time{};
  std::vector<Mark> marks;
};

/// In which tick every sample of a recorded lockstep was handled first, and at what times the ticks
/// were: what a replay needs to be the same to the bit. All of it comes from the orders on record,
/// nothing from the clocks of the machine.
class LockstepScript {
 public:
  /// Throws std::invalid_argument for captures of more than one life of the master of time.
  LockstepScript(const std::vector<RecordedRoster>& rosters,
                 const std::vector<RecordedOrder>& orders);

  struct Tick {
    std::uint64_t number = 0;
    Time time{};
  };
  /// In order.
  [[nodiscard]] const std::vector<Tick>& ticks() const { return ticks_; }

  /// 0: written before the first tick, to be found by those who come then; nothing: never handled.
  [[nodiscard]] std::optional<std::uint64_t> tick_of(const std::string& writer,
                                                     std::uint64_t sequence) const;

  /// Where the writer stands among all in the order in which samples of a tick are handled.
  struct Rank {
    std::string member;
    std::uint32_t endpoint = 0;
    // clang-tidy 14 takes the 0 of the comparison for a pointer.
    // NOLINTNEXTLINE(modernize-use-nullptr)
    auto operator<=>(const Rank&) const = default;
  };
  [[nodiscard]] std::optional<Rank> rank_of(const std::string& writer) const;

 private:
  struct Writer {
    Rank rank;
    bool latched = false;
    std::uint64_t base = 0;
    /// Last sequence number handled by a tick, by that number.
    std::map<std::uint64_t, std::uint64_t> ticks;
  };
  std::map<std::string, Writer> writers_;
  std::vector<Tick> ticks_;
};

}  // namespace coop::capture
