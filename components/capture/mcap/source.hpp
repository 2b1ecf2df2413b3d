#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "capture/mcap/records.hpp"

namespace coop::mcap {

/// Bytes to read from any place: a file, or memory. Calls may come from several threads.
class Source {
 public:
  virtual ~Source() = default;
  /// As it was when opened: a file that is still being written is read up to there.
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// Fills `out`. Throws FileError where the source ends before (a file cut while it is read),
  /// std::system_error where reading fails.
  virtual void read(std::uint64_t offset, std::span<std::byte> out) const = 0;
  /// For messages: the file's name.
  [[nodiscard]] virtual const std::string& name() const = 0;
};

/// A capture, with the chunks of its tail where its writer was killed (tail.hpp); a folder is a
/// ring (ring_rescue.hpp). Throws std::system_error naming the file.
[[nodiscard]] std::shared_ptr<const Source> open_file(const std::filesystem::path& path);
/// Any file, as it is.
[[nodiscard]] std::shared_ptr<const Source> open_plain_file(const std::filesystem::path& path);
[[nodiscard]] std::shared_ptr<const Source> open_memory(std::vector<std::byte> bytes,
                                                        std::string name = "memory");

}  // namespace coop::mcap
