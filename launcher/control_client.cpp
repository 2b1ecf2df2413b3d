#include "launcher/control_client.hpp"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "core/runtime_folder.hpp"
#include "launcher/system_lock.hpp"
#include "launcher/unix_socket.hpp"

namespace coop::launcher {
namespace {

constexpr int kAnswerTimeoutMs = 5000;

struct Found {
  std::string name;  ///< DOMAIN or DOMAIN-ROBOT
  FileDescriptor socket;
};

bool is_wanted(const std::string& name, std::optional<int> domain,
               const std::optional<std::string>& robot) {
  int its_domain = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), its_domain);
  if (error != std::errc{}) return false;
  const std::string its_robot = *end == '-' ? std::string(end + 1) : "";
  return (!domain || *domain == its_domain) && (!robot || *robot == its_robot);
}

std::vector<Found> find_launchers(std::optional<int> domain,
                                  const std::optional<std::string>& robot) {
  std::vector<Found> found;
  std::vector<std::filesystem::path> seen;
  for (const auto& folder : runtime_folders()) {
    std::error_code error;
    const auto canonical = std::filesystem::canonical(folder, error);
    if (error || std::ranges::find(seen, canonical) != seen.end()) continue;
    seen.push_back(canonical);
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
      const std::string name = entry.path().stem().string();
      if (entry.path().extension() != ".sock" || !is_wanted(name, domain, robot)) continue;
      // A dead launcher's socket does not answer.
      auto socket = connect_unix(entry.path().string());
      if (socket) found.push_back({name, std::move(*socket)});
    }
  }
  return found;
}

}  // namespace

Result<ControlClient> ControlClient::connect(std::optional<int> domain,
                                             const std::optional<std::string>& robot) {
  std::vector<Found> found = find_launchers(domain, robot);
  if (found.empty()) {
    return fail("no system runs" +
                (domain ? " as " + system_name(robot.value_or(""), *domain) : std::string()) +
                "; start one with `coop up FILE`");
  }
  if (found.size() > 1) {
    std::string names;
    for (const Found& launcher : found) names += " " + launcher.name;
    return fail("several systems run (domain or domain-robot:" + names +
                "); choose with --domain and --robot");
  }
  return ControlClient(std::move(found.front().socket));
}

Result<ControlReply> ControlClient::ask(const ControlRequest& request) {
  const std::string line = encode(request) + "\n";
  if (send(socket_.get(), line.data(), line.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(line.size())) {
    return fail("the launcher is gone");
  }
  std::string answer;
  while (answer.find('\n') == std::string::npos) {
    pollfd file{socket_.get(), POLLIN, 0};
    if (poll(&file, 1, kAnswerTimeoutMs) <= 0) return fail("the launcher does not answer");
    char buffer[4096];
    const ssize_t count = read(socket_.get(), buffer, sizeof buffer);
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count <= 0) return fail("the launcher is gone");
    answer.append(buffer, static_cast<std::size_t>(count));
  }
  auto reply = decode_reply(answer.substr(0, answer.find('\n')));
  if (reply && !reply->ok) return fail(reply->error);
  return reply;
}

bool ControlClient::wait_for_end(std::chrono::milliseconds timeout) {
  pollfd file{socket_.get(), POLLIN, 0};
  if (poll(&file, 1, static_cast<int>(timeout.count())) <= 0) return false;
  char byte = 0;
  return read(socket_.get(), &byte, 1) <= 0;
}

}  // namespace coop::launcher
