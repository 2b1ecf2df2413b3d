#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/child_process.hpp"

namespace coop::sweep {

/// The full path of a program that the user's shell would start by this name; empty where there is
/// none.
[[nodiscard]] std::filesystem::path find_in_path(const std::string& program);

/// What a program answered: stdout and stderr as one text.
struct Answer {
  int code = 0;
  std::string text;

  /// The first line that is not empty, for messages.
  [[nodiscard]] std::string line() const;
};

/// Of a program's output.
[[nodiscard]] std::string last_line(const std::filesystem::path& file);

/// A short program of which only the answer counts.
class Command {
 public:
  /// `output`: a file for its answer. Throws std::system_error where it cannot be started.
  Command(const std::vector<std::string>& words, const std::filesystem::path& output);

  /// Once it has ended.
  [[nodiscard]] std::optional<Answer> poll();
  [[nodiscard]] Answer wait();

 private:
  std::filesystem::path output_;
  ChildProcess process_;
};

}  // namespace coop::sweep
