#include "launcher/unix_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>

namespace coop::launcher {
namespace {

constexpr int kBacklog = 16;

Result<FileDescriptor> failed() {
  return fail(std::string(strerror(errno)));
}

FileDescriptor new_socket() {
  return FileDescriptor(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

}  // namespace

UnixAddress::UnixAddress(const std::string& name) {
  address_.sun_family = AF_UNIX;
  const std::size_t length = std::min(name.size(), sizeof address_.sun_path - 1);
  std::copy_n(name.begin(), length, address_.sun_path);
  size_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + length);
  if (name.starts_with('@')) {
    address_.sun_path[0] = '\0';
  } else {
    size_ += 1;
  }
}

Result<FileDescriptor> listen_unix(const std::string& name) {
  if (name.size() >= sizeof(sockaddr_un::sun_path)) return fail("path too long: " + name);
  FileDescriptor socket = new_socket();
  const UnixAddress address(name);
  if (!socket.valid() || bind(socket.get(), address.get(), address.size()) != 0 ||
      listen(socket.get(), kBacklog) != 0) {
    return failed();
  }
  return socket;
}

Result<FileDescriptor> connect_unix(const std::string& name) {
  if (name.size() >= sizeof(sockaddr_un::sun_path)) return fail("path too long: " + name);
  FileDescriptor socket = new_socket();
  const UnixAddress address(name);
  if (!socket.valid() || connect(socket.get(), address.get(), address.size()) != 0) return failed();
  return socket;
}

std::optional<Peer> peer_of(int socket) {
  ucred credentials{};
  socklen_t size = sizeof credentials;
  if (getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &credentials, &size) != 0) return std::nullopt;
  return Peer{credentials.pid, credentials.uid};
}

}  // namespace coop::launcher
