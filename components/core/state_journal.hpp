#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace coop {

/// The newest state of something that runs on, on disk, so that a program that was killed goes on
/// from there. Two slots in one file are written in turn, each with number and checksum: a record
/// torn by the end of the process leaves the one before it. A record costs one write into the page
/// cache; that outlives the process, though not the machine.
class StateJournal {
 public:
  /// Creates the file and its folder where missing; records of a file made for the same capacity
  /// (bytes a record may have) stay until overwritten, others go. Throws std::system_error.
  StateJournal(const std::filesystem::path& path, std::size_t capacity);
  ~StateJournal();
  StateJournal(const StateJournal&) = delete;
  StateJournal& operator=(const StateJournal&) = delete;

  /// Throws std::system_error (disk full) or std::length_error (beyond the capacity).
  void write(std::string_view record);

  /// The newest whole record of the file; nothing where there is no file or no whole record.
  [[nodiscard]] static std::optional<std::string> newest(const std::filesystem::path& path);

 private:
  std::filesystem::path path_;
  std::size_t slot_size_;
  int fd_ = -1;
  std::uint64_t number_ = 0;
  std::string block_;
};

}  // namespace coop
