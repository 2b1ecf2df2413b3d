#include "launcher/display.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string_view>

namespace coop::launcher {
namespace {

constexpr std::size_t kShownEvents = 8;

/// Bytes that are no printable text must not reach the terminal: they could be its commands.
std::string printable(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x20 || byte == 0x7F ? '?' : c;
  }
  return out;
}

class LineDisplay : public Display {
 public:
  LineDisplay(std::FILE* out, bool quiet) : out_(out), quiet_(quiet) {}
  void event(double at, const std::string& component, const std::string& text) override {
    if (quiet_) return;
    std::fprintf(out_, "%s\n", printable(event_line(at, component, text)).c_str());
    std::fflush(out_);
  }
  void output(const std::string& component, std::string_view data) override {
    std::string& line = lines_[component];
    line += data;
    for (std::size_t end = line.find('\n'); end != std::string::npos; end = line.find('\n')) {
      std::fprintf(out_, "%s| %s\n", component.c_str(), printable(line.substr(0, end)).c_str());
      line.erase(0, end + 1);
    }
    std::fflush(out_);
  }
  void refresh(const SystemView&) override {}
  void end() override {}

 private:
  std::FILE* out_;
  bool quiet_;
  std::map<std::string, std::string> lines_;
};

class TableDisplay : public Display {
 public:
  explicit TableDisplay(std::FILE* out) : out_(out) {}
  void event(double at, const std::string& component, const std::string& text) override {
    remember(printable(event_line(at, component, text)));
    draw();
  }
  void output(const std::string& component, std::string_view data) override {
    std::string& line = lines_[component];
    line += data;
    for (std::size_t end = line.find('\n'); end != std::string::npos; end = line.find('\n')) {
      remember(component + "| " + printable(line.substr(0, end)));
      line.erase(0, end + 1);
    }
  }
  void refresh(const SystemView& system) override {
    winsize size{};
    width_ = ioctl(fileno(out_), TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 120U;
    height_ = size.ws_row > 5 ? size.ws_row : 50U;
    table_ = format_table(system, width_ - 1);
    for (std::string& line : table_) line = printable(line);
    draw();
  }
  void end() override { drawn_ = 0; }

 private:
  void remember(std::string line) {
    events_.push_back(std::move(line));
    while (events_.size() > kShownEvents) events_.pop_front();
  }

  /// Over the drawing before: up, then every line with its rest cleared.
  void draw() {
    std::vector<std::string> lines = table_;
    lines.insert(lines.end(), events_.begin(), events_.end());
    if (lines.size() >= height_) lines.resize(height_ - 1);
    if (drawn_ > 0) std::fprintf(out_, "\x1b[%zuA", drawn_);
    for (const std::string& line : lines) {
      std::fprintf(out_, "%s\x1b[K\n", line.substr(0, width_ - 1).c_str());
    }
    std::fputs("\x1b[J", out_);
    std::fflush(out_);
    drawn_ = lines.size();
  }

  std::FILE* out_;
  std::size_t width_ = 120;
  std::size_t height_ = 50;
  std::size_t drawn_ = 0;
  std::vector<std::string> table_;
  std::deque<std::string> events_;
  std::map<std::string, std::string> lines_;
};

}  // namespace

std::string event_line(double at, const std::string& component, const std::string& text) {
  char stamp[32];
  std::snprintf(stamp, sizeof stamp, "[%7.2f] ", at);
  return stamp + (component.empty() ? std::string() : component + ": ") + text;
}

std::unique_ptr<Display> make_display(std::FILE* out, bool quiet) {
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  if (!quiet && !dumb && isatty(fileno(out)) == 1) return std::make_unique<TableDisplay>(out);
  return std::make_unique<LineDisplay>(out, quiet);
}

}  // namespace coop::launcher
