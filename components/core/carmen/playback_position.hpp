#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/state_journal.hpp"
#include "core/time.hpp"

namespace coop::carmen {

/// How far a log was played, in a file that outlives the player: one that was killed goes on from
/// there.
class PlaybackPosition {
 public:
  /// What is played, to tell the position in one log from that in another.
  struct Log {
    std::uint64_t records = 0;
    Time begin{};
    Time end{};
    bool operator==(const Log&) const = default;
  };
  struct Mark {
    std::uint64_t taken = 0;   ///< records that are known to have reached all readers
    Time clock{};              ///< newest time that was, or was about to be, told
    std::int64_t readers = 0;  ///< of the records
    bool operator==(const Mark&) const = default;
  };

  /// Reads what an earlier life left and opens the file, which is created where it is missing.
  /// Throws std::system_error.
  PlaybackPosition(std::filesystem::path path, const Log& log);

  /// The mark of an earlier life that played the same log.
  [[nodiscard]] const std::optional<Mark>& found() const { return found_; }

  /// One write into the page cache, and none where nothing has changed. Throws std::system_error.
  void write(const Mark& mark);
  /// The log was played: the next life begins at its beginning.
  void forget();

 private:
  std::filesystem::path path_;
  Log log_;
  std::optional<Mark> found_;
  std::optional<Mark> written_;
  std::unique_ptr<StateJournal> journal_;
};

}  // namespace coop::carmen
