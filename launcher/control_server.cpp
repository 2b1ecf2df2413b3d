#include "launcher/control_server.hpp"

#include <sys/stat.h>

#include <cerrno>

#include "core/config/error.hpp"
#include "core/runtime_folder.hpp"
#include "launcher/unix_socket.hpp"

namespace coop::launcher {
namespace {

constexpr std::size_t kMaxConnections = 16;
constexpr std::size_t kMaxLine = 4096;

}  // namespace

ControlServer::ControlServer(EventLoop& loop, const std::string& robot, int domain, Handler handler)
    : loop_(loop), handler_(std::move(handler)) {
  std::string problem = "no folder for it";
  for (const auto& folder : runtime_folders()) {
    if (!make_private_folder(folder)) continue;
    path_ = folder / control_file_name(robot, domain);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    const mode_t before = umask(0177);
    auto socket = listen_unix(path_.string());
    umask(before);
    if (socket) {
      socket_ = std::move(*socket);
      break;
    }
    problem = path_.string() + ": " + socket.error();
  }
  if (!socket_.valid()) throw config::Error("control socket: " + problem);
  loop_.watch(socket_.get(), [this] { accept_one(); });
}

ControlServer::~ControlServer() {
  loop_.unwatch(socket_.get());
  for (const auto& [fd, connection] : connections_) loop_.unwatch(fd);
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void ControlServer::accept_one() {
  FileDescriptor socket(accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!socket.valid() || connections_.size() >= kMaxConnections) return;
  const auto peer = peer_of(socket.get());
  if (!peer || (peer->uid != geteuid() && peer->uid != 0)) return;
  const int fd = socket.get();
  connections_[fd].socket = std::move(socket);
  loop_.watch(fd, [this, fd] { read_from(fd); });
}

void ControlServer::read_from(int fd) {
  Connection& connection = connections_[fd];
  char buffer[kMaxLine];
  const ssize_t count = read(fd, buffer, sizeof buffer);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (count <= 0) return close(fd);
  connection.input.append(buffer, static_cast<std::size_t>(count));
  for (std::size_t end = connection.input.find('\n'); end != std::string::npos;
       end = connection.input.find('\n')) {
    const std::string line = connection.input.substr(0, end);
    connection.input.erase(0, end + 1);
    if (!answer(connection, line)) return close(fd);
  }
  if (connection.input.size() > kMaxLine) close(fd);
}

bool ControlServer::answer(Connection& connection, const std::string& line) {
  const auto request = decode_request(line);
  ControlReply reply;
  if (request) {
    reply = handler_(*request);
  } else {
    reply.ok = false;
    reply.error = request.error();
  }
  // An answer fits the socket's buffer; who does not read his answers is not waited for.
  const std::string text = encode(reply) + "\n";
  return send(connection.socket.get(), text.data(), text.size(), MSG_NOSIGNAL) ==
         static_cast<ssize_t>(text.size());
}

void ControlServer::close(int fd) {
  loop_.unwatch(fd);
  connections_.erase(fd);
}

}  // namespace coop::launcher
