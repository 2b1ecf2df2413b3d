#include "launcher/log_file.hpp"

#include <fcntl.h>

#include <cerrno>
#include <system_error>

namespace coop::launcher {
namespace {

constexpr std::size_t kLongestLine = 300;

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r") == std::string_view::npos;
}

}  // namespace

LogFile::LogFile(std::filesystem::path path, double max_size_mb, int keep)
    : path_(std::move(path)),
      max_size_(static_cast<std::uint64_t>(max_size_mb * 1e6)),
      keep_(keep) {
  open();
}

void LogFile::open() {
  file_.reset(::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  std::error_code error;
  const auto size = std::filesystem::file_size(path_, error);
  size_ = error ? 0 : size;
}

void LogFile::rotate() {
  std::error_code ignored;  // a full disk or a missing folder shows when writing
  const auto numbered = [this](int number) {
    return path_.string() + "." + std::to_string(number);
  };
  if (keep_ == 0) std::filesystem::remove(path_, ignored);
  for (int number = keep_; number > 1; --number) {
    std::filesystem::rename(numbered(number - 1), numbered(number), ignored);
  }
  if (keep_ > 0) std::filesystem::rename(path_, numbered(1), ignored);
  open();
}

void LogFile::append(std::string_view data) {
  if (data.empty()) return;
  remember(data);
  if (size_ > 0 && size_ + data.size() > max_size_) rotate();
  if (lost_ > 0 && write_all("[launcher: " + std::to_string(lost_) + " bytes lost here]\n"))
    lost_ = 0;
  if (!write_all(data)) lost_ += data.size();
}

bool LogFile::write_all(std::string_view data) {
  while (!data.empty()) {
    const ssize_t count = write(file_.get(), data.data(), data.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    size_ += static_cast<std::uint64_t>(count);
    data.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

void LogFile::remember(std::string_view data) {
  while (!data.empty()) {
    const std::size_t end = data.find('\n');
    const std::string_view part = data.substr(0, end);
    if (line_.size() < kLongestLine) line_ += part.substr(0, kLongestLine - line_.size());
    if (end == std::string_view::npos) return;
    if (!is_blank(line_)) last_line_ = line_;
    line_.clear();
    data.remove_prefix(end + 1);
  }
}

std::string LogFile::last_line() const {
  return is_blank(line_) ? last_line_ : line_;
}

}  // namespace coop::launcher
