#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "launcher/control_protocol.hpp"
#include "launcher/event_loop.hpp"

namespace coop::launcher {

/// Answers control requests on a Unix socket that only this user (and root) may open.
class ControlServer {
 public:
  using Handler = std::function<ControlReply(const ControlRequest&)>;

  /// Throws config::Error where no socket can be made. The caller holds the SystemLock: a socket
  /// file found there is a dead launcher's.
  ControlServer(EventLoop& loop, const std::string& robot, int domain, Handler handler);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  struct Connection {
    FileDescriptor socket;
    std::string input;
  };

  void accept_one();
  void read_from(int fd);
  bool answer(Connection& connection, const std::string& line);
  void close(int fd);

  EventLoop& loop_;
  Handler handler_;
  std::filesystem::path path_;
  FileDescriptor socket_;
  std::map<int, Connection> connections_;
};

}  // namespace coop::launcher
