#include "sweep/node/command.hpp"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "core/atomic_file.hpp"

namespace coop::sweep {

std::filesystem::path find_in_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = std::filesystem::path(folder) / program;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0) {
      return file;
    }
  }
  return {};
}

std::string Answer::line() const {
  std::istringstream lines(text);
  std::string line;
  while (line.empty() && std::getline(lines, line)) continue;
  return line.empty() ? "exit code " + std::to_string(code) : line;
}

std::string last_line(const std::filesystem::path& file) {
  std::string text = read_file(file);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const auto end = text.rfind('\n');
  return end == std::string::npos ? text : text.substr(end + 1);
}

Command::Command(const std::vector<std::string>& words, const std::filesystem::path& output)
    : output_(output), process_(words, output) {}

std::optional<Answer> Command::poll() {
  const auto code = process_.poll();
  if (!code) return std::nullopt;
  return Answer{*code, read_file(output_)};
}

Answer Command::wait() {
  const int code = process_.wait();
  return {code, read_file(output_)};
}

}  // namespace coop::sweep
