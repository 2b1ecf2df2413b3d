#pragma once
#include <cstdio>
#include <deque>
#include <memory>
#include <string>

#include "launcher/health.hpp"
#include "launcher/system_view.hpp"

namespace coop::launcher {

/// What a person sees while the system runs.
class Display {
 public:
  virtual ~Display() = default;
  /// Something has happened; `component` is empty for the system as a whole. `at`: s since the
  /// start.
  virtual void event(double at, const std::string& component, const std::string& text) = 0;
  /// A component's own output.
  virtual void output(const std::string& component, std::string_view data) = 0;
  virtual void refresh(const SystemView& system) = 0;
  /// The system has ended: nothing is redrawn after this.
  virtual void end() = 0;
};

/// A live table on a terminal, lines otherwise.
[[nodiscard]] std::unique_ptr<Display> make_display(std::FILE* out, bool quiet);

/// "[  1.24] dwa: ready", as it stands in launcher.log as well.
[[nodiscard]] std::string event_line(double at, const std::string& component,
                                     const std::string& text);

}  // namespace coop::launcher
