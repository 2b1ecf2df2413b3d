#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "capture/mcap/records.hpp"

namespace coop::mcap {

/// Where a file's bytes go.
class Sink {
 public:
  virtual ~Sink() = default;
  /// Appends the parts, one after the other, with one system call where the system takes them at
  /// once. Throws std::system_error (disk full, ...); what was appended before that call stands,
  /// and what it left of its own is cut off again.
  virtual void write(std::span<const Bytes> parts) = 0;
  /// Waits until all of it is on the disk.
  virtual void sync() = 0;
};

/// Creates the file, or empties it. Throws std::system_error naming it. `reserve`: bytes of the
/// disk that are left to others: it counts as full (ENOSPC) before.
[[nodiscard]] std::unique_ptr<Sink> create_file(const std::filesystem::path& path,
                                                std::uint64_t reserve = 0);
/// Appends to `bytes`, which has to outlive the sink.
[[nodiscard]] std::unique_ptr<Sink> write_to_memory(std::vector<std::byte>& bytes);

}  // namespace coop::mcap
