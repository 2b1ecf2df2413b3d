#include "capture/node/keyboard.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <csignal>

namespace coop::capture {
namespace {

termios before;
termios single_keys;
/// SIGCONT: the shell that stopped us has its own ideas of the terminal.
constexpr std::array kFatal{SIGQUIT, SIGABRT, SIGSEGV, SIGBUS, SIGHUP, SIGTSTP};

void restore() {
  ::tcsetattr(STDIN_FILENO, TCSANOW, &before);
}

void restore_and_die(int signal) {
  restore();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void go_on(int) {
  ::tcsetattr(STDIN_FILENO, TCSANOW, &single_keys);
  std::signal(SIGTSTP, restore_and_die);
}

}  // namespace

Keyboard::Keyboard() {
  if (::isatty(STDIN_FILENO) == 0 || ::tcgetattr(STDIN_FILENO, &before) != 0) return;
  single_keys = before;
  single_keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  single_keys.c_cc[VMIN] = 0;
  single_keys.c_cc[VTIME] = 0;
  for (const int signal : kFatal) std::signal(signal, restore_and_die);
  std::signal(SIGCONT, go_on);
  active_ = ::tcsetattr(STDIN_FILENO, TCSANOW, &single_keys) == 0;
}

Keyboard::~Keyboard() {
  if (!active_) return;
  restore();
  for (const int signal : kFatal) std::signal(signal, SIG_DFL);
  std::signal(SIGCONT, SIG_DFL);
}

std::optional<char> Keyboard::key() {
  if (!active_) return std::nullopt;
  pollfd input{STDIN_FILENO, POLLIN, 0};
  char key = 0;
  if (::poll(&input, 1, 0) <= 0 || ::read(STDIN_FILENO, &key, 1) != 1) return std::nullopt;
  return key;
}

}  // namespace coop::capture
