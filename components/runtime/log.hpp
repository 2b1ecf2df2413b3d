#pragma once
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "core/time.hpp"
#include "runtime/clock.hpp"

namespace spdlog {
class logger;
}

namespace coop::runtime {

enum class Level { kDebug, kInfo, kWarning, kError };

/// Structured log of one component: to the console as `stamp level component: text`, to
/// <dir>/<component>.jsonl as one JSON object a line {stamp, wall, level, component, text}. The
/// stamp is the component's clock. Errors of the log (disk full) never reach the component.
class Logger {
 public:
  /// `directory` empty: console only.
  Logger(std::string component, const Clock& clock, const std::filesystem::path& directory,
         Level level = Level::kInfo);
  ~Logger();
  Logger(const Logger&) = delete;
  Logger& operator=(const Logger&) = delete;

  template <class... Args>
  void debug(fmt::format_string<Args...> format, Args&&... args) {
    if (level_ <= Level::kDebug)
      write(Level::kDebug, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  void info(fmt::format_string<Args...> format, Args&&... args) {
    if (level_ <= Level::kInfo)
      write(Level::kInfo, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  void warning(fmt::format_string<Args...> format, Args&&... args) {
    write(Level::kWarning, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  void error(fmt::format_string<Args...> format, Args&&... args) {
    write(Level::kError, fmt::format(format, std::forward<Args>(args)...));
  }

  /// True at most once in `interval` of the component's clock for each topic of complaint:
  /// `if (log.is_due("no_scan", seconds(5))) log.warning(...)`.
  [[nodiscard]] bool is_due(const std::string& topic, Duration interval);

  void write(Level level, const std::string& text);

 private:
  std::string component_;
  const Clock& clock_;
  Level level_;
  std::shared_ptr<spdlog::logger> console_;
  std::shared_ptr<spdlog::logger> file_;
  std::map<std::string, Time> last_;
};

}  // namespace coop::runtime
