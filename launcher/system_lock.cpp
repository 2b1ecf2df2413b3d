#include "launcher/system_lock.hpp"

#include <cerrno>

#include "launcher/unix_socket.hpp"

namespace coop::launcher {

std::string system_name(const std::string& robot, int domain) {
  const std::string on = "domain " + std::to_string(domain);
  return robot.empty() ? on : "robot '" + robot + "' on " + on;
}

Result<SystemLock> SystemLock::acquire(const std::string& robot, int domain) {
  const std::string name = "@coop/launcher/" + std::to_string(domain) + "/" + robot;
  auto socket = listen_unix(name);
  if (socket) return SystemLock(std::move(*socket));
  if (errno != EADDRINUSE)
    return fail("cannot lock " + system_name(robot, domain) + ": " + socket.error());
  std::string holder;
  if (const auto connection = connect_unix(name)) {
    if (const auto peer = peer_of(connection->get())) holder = ", pid " + std::to_string(peer->pid);
  }
  return fail(system_name(robot, domain) + " is in use by another launcher" + holder +
              "; stop it with `coop down` or choose another domain with --domain");
}

void SystemLock::serve(EventLoop& loop) {
  // The caller has what he wants (our pid) with the connection itself.
  loop.watch(socket_.get(), [fd = socket_.get()] {
    const FileDescriptor connection(accept4(fd, nullptr, nullptr, SOCK_CLOEXEC));
  });
}

}  // namespace coop::launcher
