#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace coop::launcher {

/// Reads a log file that grows and is rotated.
class LogTail {
 public:
  explicit LogTail(std::filesystem::path path);
  /// 0: all that is there.
  [[nodiscard]] std::string last_lines(std::size_t count);
  /// What has come since; waits for it.
  [[nodiscard]] std::string wait_for_more();
  /// The same without waiting; empty where nothing has come.
  [[nodiscard]] std::string more();

 private:
  [[nodiscard]] std::string read_rest();

  std::filesystem::path path_;
  std::ifstream file_;
  std::uint64_t inode_ = 0;
};

}  // namespace coop::launcher
