#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "launcher/file_descriptor.hpp"

namespace coop::launcher {

/// What a component prints, in a file that is rotated by size (NAME.log, NAME.log.1 is the one
/// before). A full disk loses output, never a component: what could not be written is counted and
/// said when writing works again.
class LogFile {
 public:
  LogFile(std::filesystem::path path, double max_size_mb, int keep);

  void append(std::string_view data);
  /// The last line that was not empty, cut to a readable length.
  [[nodiscard]] std::string last_line() const;
  [[nodiscard]] std::uint64_t lost_bytes() const { return lost_; }

 private:
  void open();
  void rotate();
  void remember(std::string_view data);
  bool write_all(std::string_view data);

  std::filesystem::path path_;
  std::uint64_t max_size_;
  int keep_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;
  std::uint64_t lost_ = 0;
  std::string line_;       ///< what has come of the line that is not finished
  std::string last_line_;  ///< finished and not empty
};

}  // namespace coop::launcher
