#include "launcher/event_loop.hpp"

#include <poll.h>
#include <sys/signalfd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <vector>

namespace coop::launcher {

void EventLoop::watch(int fd, Callback on_readable) {
  watched_[fd] = std::make_shared<Callback>(std::move(on_readable));
}

void EventLoop::unwatch(int fd) {
  watched_.erase(fd);
}

void EventLoop::run_once(std::optional<Instant> deadline) {
  std::vector<pollfd> files;
  files.reserve(watched_.size());
  for (const auto& [fd, callback] : watched_) files.push_back({fd, POLLIN, 0});
  timespec limit{};
  if (deadline) {
    const auto wait =
        std::max(std::chrono::nanoseconds(*deadline - std::chrono::steady_clock::now()),
                 std::chrono::nanoseconds(0));
    limit = {wait.count() / 1'000'000'000, wait.count() % 1'000'000'000};
  }
  if (ppoll(files.data(), files.size(), deadline ? &limit : nullptr, nullptr) <= 0) return;
  for (const pollfd& file : files) {
    if (file.revents == 0) continue;
    const auto found = watched_.find(file.fd);
    if (found == watched_.end()) continue;  // an earlier callback has removed it
    const std::shared_ptr<Callback> callback = found->second;
    (*callback)();
  }
}

SignalFile::SignalFile(std::initializer_list<int> numbers) {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : numbers) sigaddset(&set, number);
  if (const int problem = pthread_sigmask(SIG_BLOCK, &set, nullptr); problem != 0) {
    throw std::system_error(problem, std::generic_category(), "cannot block signals");
  }
  fd_.reset(signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
  if (!fd_.valid()) throw std::system_error(errno, std::generic_category(), "signalfd");
}

std::optional<int> SignalFile::take() {
  signalfd_siginfo info{};
  if (read(fd_.get(), &info, sizeof info) != static_cast<ssize_t>(sizeof info)) return std::nullopt;
  return static_cast<int>(info.ssi_signo);
}

}  // namespace coop::launcher
