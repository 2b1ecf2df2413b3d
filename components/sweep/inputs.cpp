#include "sweep/inputs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/hash.hpp"

namespace coop::sweep {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMaxShown = 4;

std::string hash_of(std::string_view content) {
  return fmt::format("{:016x}", fnv1a(content));
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// May hold names of further files.
bool names_others(const fs::path& file) {
  static constexpr std::array kKinds{".yaml", ".yml", ".urdf", ".xml"};
  return std::ranges::find(kKinds, file.extension()) != kKinds.end();
}

bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("_-./+~").find(c) != std::string_view::npos;
}

/// The words of a text in YAML or XML, without comments after '#'.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  bool in_comment = false;
  char before = '\n';
  for (const char c : text) {
    if (c == '\n') in_comment = false;
    if (c == '#' && std::isspace(static_cast<unsigned char>(before)) != 0) in_comment = true;
    before = c;
    if (!in_comment && is_word_character(c)) {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  if (!word.empty()) words.push_back(std::move(word));
  return words;
}

class Collector {
 public:
  Collector(const Places& places, Inputs& inputs) : places_(places), inputs_(inputs) {}

  /// `folder`: of the file that the text stands in.
  void follow(std::string_view text, const fs::path& folder) {
    for (const std::string& word : words_of(text)) follow_name(word, folder);
  }

  /// Of a file or of a program.
  void follow_name(const std::string& name, const fs::path& folder) {
    const fs::path file = find_file(name, {folder, places_.share});
    if (!file.empty()) add_file(file);
    if (name.find_first_of("./") == std::string::npos) add_program(name);
  }

  void add_program(const std::string& name) {
    const fs::path program = places_.programs / name;
    if (!is_file(program) || ::access(program.c_str(), X_OK) != 0) return;
    if (!inputs_.emplace("program " + name, hash_of(read_file(program))).second) return;
    const fs::path usual = places_.share / "config" / (name + ".yaml");
    if (is_file(usual)) add_file(usual);
  }

  void add_file(const fs::path& found) {
    const fs::path file = fs::weakly_canonical(found);
    const std::string content = read_file(file);
    if (!inputs_.emplace(name_of(file), hash_of(content)).second) return;
    if (names_others(file)) follow(content, file.parent_path());
  }

 private:
  /// The same where a checkout has been moved.
  [[nodiscard]] std::string name_of(const fs::path& file) const {
    const fs::path inside = file.lexically_relative(fs::weakly_canonical(places_.share));
    return inside.empty() || *inside.begin() == ".." ? file.string() : inside.string();
  }

  const Places& places_;
  Inputs& inputs_;
};

std::string in_lines(const std::vector<std::string>& texts) {
  std::string lines;
  for (const std::string& text : texts) lines += text + '\n';
  return lines;
}

/// Numbers of runs depend on the number of seeds where there are several points.
std::string seeds_of(const SweepConfig& config) {
  std::string text = std::to_string(config.first_seed);
  if (count_points(config) > 1) text += " " + std::to_string(config.seeds);
  return text;
}

}  // namespace

Inputs find_inputs(const SweepConfig& config, const Places& places) {
  std::string grid;
  for (const Axis& axis : config.grid) grid += axis.key + '\n' + in_lines(axis.values) + '\n';
  Inputs inputs{{"sweep: launch", hash_of(config.launch)},
                {"sweep: table", hash_of(config.table)},
                {"sweep: settings", hash_of(in_lines(config.settings))},
                {"sweep: grid", hash_of(grid)},
                {"sweep: seeds", hash_of(seeds_of(config))}};
  Collector collector(places, inputs);
  const fs::path here = fs::current_path();
  collector.add_program("launcher");
  const fs::path shipped = places.share / "config" / "launch";
  for (const char* ending : {"", ".yaml"}) {
    const fs::path file = find_file(config.launch + ending, {here, places.share, shipped});
    if (!file.empty()) collector.add_file(file);
  }
  std::vector<std::string> values;
  for (const std::string& setting : config.settings) {
    values.push_back(setting.substr(setting.find('=') + 1));
  }
  for (const Axis& axis : config.grid) {
    values.insert(values.end(), axis.values.begin(), axis.values.end());
  }
  for (const std::string& value : values) collector.follow_name(value, here);
  collector.follow(in_lines(values), here);
  const fs::path robots = places.share / "config" / "robot";
  if (fs::is_directory(robots)) {
    for (const auto& entry : fs::directory_iterator(robots)) {
      if (entry.is_regular_file()) collector.add_file(entry.path());
    }
  }
  return inputs;
}

std::string to_text(const Inputs& inputs) {
  std::string text;
  for (const auto& [name, hash] : inputs) text.append(hash).append("  ").append(name).append("\n");
  return text;
}

Inputs inputs_from_text(std::string_view text) {
  Inputs inputs;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const std::size_t gap = line.find("  ");
    if (gap == std::string_view::npos || line.size() == text.size()) {
      throw std::runtime_error(fmt::format("'{}' is no line of hash and name", line));
    }
    inputs.emplace(line.substr(gap + 2), line.substr(0, gap));
    text.remove_prefix(line.size() + 1);
  }
  return inputs;
}

std::vector<std::string> differences(const Inputs& before, const Inputs& after) {
  std::vector<std::string> names;
  for (const auto& [name, hash] : before) {
    const auto found = after.find(name);
    if (found == after.end() || found->second != hash) names.push_back(name);
  }
  for (const auto& [name, hash] : after) {
    if (!before.contains(name)) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

std::string shown_differences(const Inputs& before, const Inputs& after) {
  const std::vector<std::string> names = differences(before, after);
  const std::size_t shown = names.size() <= kMaxShown + 1 ? names.size() : kMaxShown;
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : ", ") + names[i];
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

}  // namespace coop::sweep
