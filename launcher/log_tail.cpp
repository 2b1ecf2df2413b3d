#include "launcher/log_tail.hpp"

#include <poll.h>
#include <sys/stat.h>

#include <algorithm>
#include <sstream>

namespace coop::launcher {
namespace {

constexpr int kPollMs = 100;

std::uint64_t inode_of(const std::filesystem::path& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

}  // namespace

LogTail::LogTail(std::filesystem::path path)
    : path_(std::move(path)), file_(path_, std::ios::binary), inode_(inode_of(path_)) {}

std::string LogTail::read_rest() {
  std::ostringstream text;
  file_.clear();
  if (file_.peek() != std::ifstream::traits_type::eof()) text << file_.rdbuf();
  return std::move(text).str();
}

std::string LogTail::last_lines(std::size_t count) {
  std::string text = read_rest();
  if (count == 0 || text.empty()) return text;
  std::size_t begin = text.size() - (text.back() == '\n' ? 1 : 0);
  for (; count > 0 && begin != std::string::npos && begin > 0; --count) {
    begin = text.rfind('\n', begin - 1);
  }
  return begin == std::string::npos || begin == 0 ? text : text.substr(begin + 1);
}

std::string LogTail::more() {
  std::string text = read_rest();
  const std::uint64_t inode = inode_of(path_);
  if (inode != 0 &&
      inode != inode_) {  // rotated: the rest of the old file is read, now the new one
    file_ = std::ifstream(path_, std::ios::binary);
    inode_ = inode;
    text += read_rest();
  }
  return text;
}

std::string LogTail::wait_for_more() {
  for (;;) {
    std::string text = more();
    if (!text.empty()) return text;
    poll(nullptr, 0, kPollMs);
  }
}

}  // namespace coop::launcher
