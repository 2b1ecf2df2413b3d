#pragma once
#include <chrono>
#include <optional>
#include <string>

#include "launcher/control_protocol.hpp"
#include "launcher/file_descriptor.hpp"

namespace coop::launcher {

/// Talks to a running launcher.
class ControlClient {
 public:
  /// Without a domain: the only launcher of this user that runs. The error is one line.
  [[nodiscard]] static Result<ControlClient> connect(std::optional<int> domain,
                                                     const std::optional<std::string>& robot);

  /// The error is one line: the launcher's refusal, or that it is gone.
  [[nodiscard]] Result<ControlReply> ask(const ControlRequest& request);
  /// Until the launcher has closed the connection: it has ended. False on time-out.
  [[nodiscard]] bool wait_for_end(std::chrono::milliseconds timeout);

 private:
  explicit ControlClient(FileDescriptor socket) : socket_(std::move(socket)) {}
  FileDescriptor socket_;
};

}  // namespace coop::launcher
