#pragma once
#include <optional>

namespace coop::capture {

/// Single keys of the terminal, without waiting for Enter and without echo. The terminal is as
/// before when the object is gone, when the program is stopped or killed by a signal that can be
/// caught. Signals of the keyboard (Ctrl-C) work as ever.
class Keyboard {
 public:
  /// Where stdin is no terminal nothing is done, and no key comes.
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  [[nodiscard]] bool is_terminal() const { return active_; }
  /// The next key pressed; nothing while there is none.
  [[nodiscard]] std::optional<char> key();

 private:
  bool active_ = false;
};

}  // namespace coop::capture
