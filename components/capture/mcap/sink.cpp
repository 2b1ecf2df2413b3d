#include "capture/mcap/sink.hpp"

#include <fcntl.h>
#include <limits.h>
#include <sys/statvfs.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace coop::mcap {
namespace {

class FileSink final : public Sink {
 public:
  FileSink(const std::filesystem::path& path, std::uint64_t reserve)
      : name_(path.string()),
        reserve_(reserve),
        fd_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
    if (fd_ < 0) fail(errno);
  }
  ~FileSink() override { ::close(fd_); }
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;

  void write(std::span<const Bytes> parts) override {
    vectors_.clear();
    for (const Bytes part : parts) {
      if (part.empty()) continue;
      vectors_.push_back({const_cast<std::byte*>(part.data()), part.size()});
    }
    leave_reserve();
    std::uint64_t written = 0;
    std::size_t first = 0;
    while (first < vectors_.size()) {
      const auto count = static_cast<int>(std::min<std::size_t>(vectors_.size() - first, IOV_MAX));
      ssize_t got = ::writev(fd_, &vectors_[first], count);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) {
        const int error = errno;
        cut_back();
        fail(error);
      }
      written += static_cast<std::uint64_t>(got);
      for (; got > 0; ++first) {
        iovec& vector = vectors_[first];
        if (static_cast<std::size_t>(got) < vector.iov_len) {
          vector.iov_base = static_cast<std::byte*>(vector.iov_base) + got;
          vector.iov_len -= static_cast<std::size_t>(got);
          break;
        }
        got -= static_cast<ssize_t>(vector.iov_len);
      }
    }
    size_ += written;
  }

  void sync() override {
    if (::fdatasync(fd_) != 0 && errno != EINVAL && errno != EROFS) fail(errno);
  }

 private:
  void leave_reserve() const {
    if (reserve_ == 0) return;
    std::uint64_t size = 0;
    for (const iovec& vector : vectors_) size += vector.iov_len;
    struct statvfs disk {};
    if (::fstatvfs(fd_, &disk) != 0) return;
    if (std::uint64_t{disk.f_bavail} * disk.f_frsize >= size + reserve_) return;
    throw std::system_error(
        ENOSPC, std::generic_category(),
        name_ + ": " + std::to_string(reserve_ >> 20U) + " MB are kept free for others");
  }
  /// Best effort: should it fail too, the file has a partial record at its end, which readers
  /// report and recovery cuts off.
  void cut_back() const {
    const auto size = static_cast<off_t>(size_);
    if (::ftruncate(fd_, size) == 0) static_cast<void>(::lseek(fd_, size, SEEK_SET));
  }
  [[noreturn]] void fail(int error) const {
    throw std::system_error(error, std::generic_category(), name_);
  }

  std::string name_;
  std::uint64_t reserve_;
  int fd_;
  std::uint64_t size_ = 0;
  std::vector<iovec> vectors_;
};

class MemorySink final : public Sink {
 public:
  explicit MemorySink(std::vector<std::byte>& bytes) : bytes_(bytes) {}
  void write(std::span<const Bytes> parts) override {
    for (const Bytes part : parts) bytes_.insert(bytes_.end(), part.begin(), part.end());
  }
  void sync() override {}

 private:
  std::vector<std::byte>& bytes_;
};

}  // namespace

std::unique_ptr<Sink> create_file(const std::filesystem::path& path, std::uint64_t reserve) {
  return std::make_unique<FileSink>(path, reserve);
}

std::unique_ptr<Sink> write_to_memory(std::vector<std::byte>& bytes) {
  return std::make_unique<MemorySink>(bytes);
}

}  // namespace coop::mcap
