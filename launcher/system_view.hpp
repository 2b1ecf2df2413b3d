#pragma once
#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace coop::launcher {

/// One line of the table a person sees.
struct Row {
  std::string name;
  std::string state;
  pid_t pid = 0;        ///< 0: no process
  double uptime = 0.0;  ///< s
  int restarts = 0;
  double cpu = 0.0;            ///< 1 = one core
  std::uint64_t resident = 0;  ///< bytes
  std::string detail;
};

/// A running system as `coop ps` shows it.
struct SystemView {
  std::string robot;
  int domain = 0;
  pid_t launcher = 0;
  std::string launch_file;
  std::string run_folder;
  double uptime = 0.0;  ///< s
  std::vector<Row> rows;
};

/// Table of all components with a heading and the sums. No line is longer than `width` characters.
[[nodiscard]] std::vector<std::string> format_table(const SystemView& system, std::size_t width);

}  // namespace coop::launcher
