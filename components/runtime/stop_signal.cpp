#include "runtime/stop_signal.hpp"

#include <atomic>
#include <csignal>

#include "runtime/executor.hpp"

namespace coop::runtime {
namespace {

std::atomic<bool> stop_requested{false};
std::atomic<Executor*> woken{nullptr};

void handle(int) {
  stop_requested = true;
  if (Executor* executor = woken) executor->wake();
}

}  // namespace

StopSignal::StopSignal(Executor& executor) {
  woken = &executor;
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

StopSignal::~StopSignal() {
  woken = nullptr;
}

bool StopSignal::requested() {
  return stop_requested;
}

}  // namespace coop::runtime
