#pragma once
#include <string>

#include "core/result.hpp"
#include "launcher/event_loop.hpp"
#include "launcher/file_descriptor.hpp"

namespace coop::launcher {

/// One launcher a robot and domain: two would start the same components twice on the same topics.
/// Held by a socket that the kernel takes back when the launcher dies, however it dies.
class SystemLock {
 public:
  /// The error is one line that names the launcher that holds it.
  [[nodiscard]] static Result<SystemLock> acquire(const std::string& robot, int domain);
  /// Answers those who ask who holds it.
  void serve(EventLoop& loop);

 private:
  explicit SystemLock(FileDescriptor socket) : socket_(std::move(socket)) {}
  FileDescriptor socket_;
};

/// "robot 'x' on domain 3", "domain 3".
[[nodiscard]] std::string system_name(const std::string& robot, int domain);

}  // namespace coop::launcher
