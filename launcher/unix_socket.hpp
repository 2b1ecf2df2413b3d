#pragma once
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/un.h>

#include <optional>
#include <string>

#include "core/result.hpp"
#include "launcher/file_descriptor.hpp"

namespace coop::launcher {

/// Address of a Unix socket. A name that starts with '@' lies in Linux's abstract name space: it
/// exists as long as its owner, and in one network name space only, exactly the reach of a DDS
/// domain on this machine.
class UnixAddress {
 public:
  explicit UnixAddress(const std::string& name);
  [[nodiscard]] const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&address_); }
  [[nodiscard]] socklen_t size() const { return size_; }

 private:
  sockaddr_un address_{};
  socklen_t size_ = 0;
};

/// The error is errno's text; EADDRINUSE is "Address already in use".
[[nodiscard]] Result<FileDescriptor> listen_unix(const std::string& name);
[[nodiscard]] Result<FileDescriptor> connect_unix(const std::string& name);

struct Peer {
  pid_t pid = 0;
  uid_t uid = 0;
};
[[nodiscard]] std::optional<Peer> peer_of(int socket);

}  // namespace coop::launcher
