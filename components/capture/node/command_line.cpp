#include "capture/node/command_line.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

#include "capture/traffic/duration_text.hpp"

namespace coop::capture {
namespace {

/// Single quotes of YAML, in which only the quote itself is special.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

}  // namespace

void CommandLine::set(const std::string& key, const std::string& value) {
  arguments_.insert(arguments_.end(), {"--set", key + "=" + value});
}

void CommandLine::set(const std::string& key, const std::vector<std::string>& values) {
  if (values.empty()) return;
  std::string list;
  for (const std::string& value : values) list += (list.empty() ? "" : ", ") + quoted(value);
  set(key, "[" + list + "]");
}

void CommandLine::pass_on(const std::vector<std::string>& arguments) {
  arguments_.insert(arguments_.end(), arguments.begin(), arguments.end());
}

std::vector<const char*> CommandLine::argv() const {
  std::vector<const char*> argv;
  for (const std::string& argument : arguments_) argv.push_back(argument.c_str());
  return argv;
}

int parse_or_exit_code(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {
    return app.exit(wanted);
  } catch (const CLI::ParseError& problem) {
    std::cerr << app.get_name() << ": " << problem.what() << " (see --help)\n";
    return 2;
  } catch (const std::exception& problem) {
    std::cerr << app.get_name() << ": " << problem.what() << '\n';
    return 1;
  }
  return kGoOn;
}

std::string in_seconds(const std::string& option, const std::string& text) {
  const auto value = parse_duration(text);
  if (!value) {
    throw CLI::ValidationError(
        option + ": expected a duration such as 90, 90s, 10min or 2h, found '" + text + "'");
  }
  return std::to_string(*value);
}

}  // namespace coop::capture
