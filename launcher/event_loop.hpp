#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "launcher/file_descriptor.hpp"
#include "launcher/health.hpp"

namespace coop::launcher {

/// Waits for files to become readable and calls back, on one thread.
class EventLoop {
 public:
  using Callback = std::function<void()>;

  /// `fd` stays the caller's; remove it before it is closed. A callback may add and remove files.
  void watch(int fd, Callback on_readable);
  void unwatch(int fd);
  /// Waits until something is readable or `deadline` has passed, then calls back for all that is.
  void run_once(std::optional<Instant> deadline);

 private:
  std::map<int, std::shared_ptr<Callback>> watched_;
};

/// Signals as a file: those given are blocked in this thread and all it starts, and read here.
class SignalFile {
 public:
  /// Throws std::system_error.
  explicit SignalFile(std::initializer_list<int> numbers);
  [[nodiscard]] int fd() const { return fd_.get(); }
  /// The next signal that has arrived, or nothing.
  [[nodiscard]] std::optional<int> take();

 private:
  FileDescriptor fd_;
};

}  // namespace coop::launcher
