#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>

namespace coop::mcap {

/// What is wrong with a file, and at which byte of it: "x.mcap: byte 4711: ...". Bytes inside a
/// compressed chunk are named by the chunk's offset.
class FileError : public std::runtime_error {
 public:
  FileError(std::uint64_t offset, const std::string& what)
      : std::runtime_error("byte " + std::to_string(offset) + ": " + what), offset_(offset) {}
  FileError(const std::string& file, const FileError& error)
      : std::runtime_error(file + ": " + error.what()), offset_(error.offset_) {}
  [[nodiscard]] std::uint64_t offset() const { return offset_; }

 private:
  std::uint64_t offset_;
};

}  // namespace coop::mcap
