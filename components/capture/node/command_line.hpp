#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace coop::capture {

/// The command line of a program that is a component too: options for people become settings of its
/// configuration, everything else is passed on (`--domain`, `--robot`, `--config`, and what the
/// launcher gives).
class CommandLine {
 public:
  explicit CommandLine(std::string program) : arguments_{std::move(program)} {}

  /// `key=value` of the configuration.
  void set(const std::string& key, const std::string& value);
  /// A list of texts.
  void set(const std::string& key, const std::vector<std::string>& values);
  void pass_on(const std::vector<std::string>& arguments);

  /// For runtime::run(), as long as this object lives.
  [[nodiscard]] std::vector<const char*> argv() const;

 private:
  std::vector<std::string> arguments_;
};

/// Parses; answers an exit code where the program has nothing more to do: help was asked for, or
/// the usage was wrong (one line on stderr, 2), or a command has thrown (the same, 1). Options that
/// `app` does not know are left to the caller.
[[nodiscard]] int parse_or_exit_code(CLI::App& app, int argc, const char* const* argv);
inline constexpr int kGoOn = -1;

/// A check for options: "90", "10min", "2h" become seconds as a plain number; throws
/// CLI::ValidationError.
[[nodiscard]] std::string in_seconds(const std::string& option, const std::string& text);

}  // namespace coop::capture
