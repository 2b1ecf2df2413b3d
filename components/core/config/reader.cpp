#include "core/config/reader.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/config/config.hpp"

namespace coop::config {
namespace {

std::string shown(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string shown(const YAML::Node& node) {
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  if (node.IsSequence()) return "a list";
  return node.IsMap() ? "a mapping" : "nothing";
}

bool is_quoted(const YAML::Node& node) {
  return node.Tag() == "!";
}

/// A value as one line of YAML that reads back as the same value.
void emit_in_one_line(YAML::Emitter& out, const YAML::Node& node) {
  if (node.IsMap()) {
    out << YAML::Flow << YAML::BeginMap;
    for (const auto& entry : node) {
      out << YAML::Key << entry.first.as<std::string>("") << YAML::Value;
      emit_in_one_line(out, entry.second);
    }
    out << YAML::EndMap;
  } else if (node.IsSequence()) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const auto& item : node) emit_in_one_line(out, item);
    out << YAML::EndSeq;
  } else if (node.IsScalar()) {
    if (is_quoted(node)) out << YAML::DoubleQuoted;
    out << node.Scalar();
  } else {
    out << YAML::Null;
  }
}

std::string in_one_line(const YAML::Node& node) {
  if (node.IsScalar() && !is_quoted(node)) return node.Scalar();
  YAML::Emitter out;
  emit_in_one_line(out, node);
  return out.c_str();
}

}  // namespace

std::string Source::where(const YAML::Node& node, const std::string& key) const {
  if (overridden.contains(key)) return "--set";
  return name + ":" + std::to_string(node.Mark().line + 1);
}

Reader::Reader(const YAML::Node& root, const Source& source) : source_(source) {
  stack_.push_back({root, "", {}});
}

YAML::Node Reader::take(std::string_view name) {
  Level& level = stack_.back();
  level.known.emplace_back(name);
  if (!level.node.IsDefined() || !level.node.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  const YAML::Node& mapping = level.node;
  return mapping[std::string(name)];
}

std::string Reader::path_of(std::string_view name) const {
  const std::string& path = stack_.back().path;
  return path.empty() ? std::string(name) : path + "." + std::string(name);
}

void Reader::reject(const YAML::Node& node, std::string_view name,
                    const std::string& expected) const {
  const std::string key = path_of(name);
  throw Error(source_.where(node, key) + ": " + key + ": expected " + expected + ", got " +
              shown(node));
}

void Reader::check_bounds(const YAML::Node& node, std::string_view name, double value,
                          const Spec& spec) const {
  if (value >= spec.min && value <= spec.max) return;
  std::string bounds;
  if (std::isfinite(spec.min) && std::isfinite(spec.max)) {
    bounds = "from " + shown(spec.min) + " to " + shown(spec.max);
  } else {
    bounds = std::isfinite(spec.min) ? "of at least " + shown(spec.min)
                                     : "of at most " + shown(spec.max);
  }
  const std::string unit = spec.unit.empty() ? "" : " (" + std::string(spec.unit) + ")";
  reject(node, name, "a number " + bounds + unit);
}

template <class T>
T Reader::scalar(const YAML::Node& node, std::string_view name, const char* expected) const {
  T value{};
  if (!node.IsScalar() || !YAML::convert<T>::decode(node, value)) reject(node, name, expected);
  return value;
}

void Reader::require_sequence(const YAML::Node& node, std::string_view name, const char* of) const {
  if (!node.IsSequence()) reject(node, name, std::string("a list of ") + of);
}

void Reader::number(std::string_view name, double& value, const Spec& spec) {
  const YAML::Node node = take(name);
  if (!node.IsDefined()) return;
  if (is_quoted(node)) reject(node, name, "a number");
  const auto read = scalar<double>(node, name, "a number");
  if (std::isnan(read)) reject(node, name, "a number");
  check_bounds(node, name, read, spec);
  value = read;
}

void Reader::integer(std::string_view name, std::int64_t& value, const Spec& spec) {
  const YAML::Node node = take(name);
  if (!node.IsDefined()) return;
  if (is_quoted(node)) reject(node, name, "a whole number");
  const auto read = scalar<std::int64_t>(node, name, "a whole number");
  check_bounds(node, name, static_cast<double>(read), spec);
  value = read;
}

void Reader::flag(std::string_view name, bool& value, const Spec&) {
  const YAML::Node node = take(name);
  if (!node.IsDefined()) return;
  if (is_quoted(node)) reject(node, name, "true or false");
  value = scalar<bool>(node, name, "true or false");
}

void Reader::text(std::string_view name, std::string& value, const Spec&) {
  const YAML::Node node = take(name);
  if (node.IsDefined()) value = scalar<std::string>(node, name, "a text");
}

void Reader::choice(std::string_view name, std::string& value,
                    std::span<const std::string_view> choices, const Spec&) {
  const YAML::Node node = take(name);
  if (!node.IsDefined()) return;
  std::string expected = "one of";
  const char* separator = " ";
  for (const std::string_view choice : choices) {
    expected += separator + std::string(choice);
    separator = ", ";
  }
  auto read = scalar<std::string>(node, name, expected.c_str());
  if (std::ranges::find(choices, read) == choices.end()) reject(node, name, expected);
  value = std::move(read);
}

void Reader::numbers(std::string_view name, std::vector<double>& value, const Spec& spec) {
  const YAML::Node node = take(name);
  if (!node.IsDefined()) return;
  require_sequence(node, name, "numbers");
  std::vector<double> read;
  for (const YAML::Node& item : node) {
    read.push_back(scalar<double>(item, name, "a list of numbers"));
    check_bounds(item, name, read.back(), spec);
  }
  value = std::move(read);
}

void Reader::texts(std::string_view name, std::vector<std::string>& value, const Spec&) {
  const YAML::Node node = take(name);
  if (!node.IsDefined()) return;
  require_sequence(node, name, "texts");
  std::vector<std::string> read;
  for (const YAML::Node& item : node) {
    read.push_back(scalar<std::string>(item, name, "a list of texts"));
  }
  value = std::move(read);
}

void Reader::flatten(const YAML::Node& node, const std::string& path, const std::string& prefix,
                     std::vector<Assignment>& value) const {
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>("");
    if (entry.second.IsMap() && entry.second.size() > 0) {
      flatten(entry.second, path + "." + key, prefix + key + ".", value);
      continue;
    }
    const std::string in_yaml = in_one_line(entry.second);
    Assignment read{prefix + key, in_yaml,
                    entry.second.IsScalar() ? entry.second.Scalar() : in_yaml,
                    source_.where(entry.first, path + "." + key)};
    const auto same = std::ranges::find(value, read.key, &Assignment::key);
    if (same == value.end()) {
      value.push_back(std::move(read));
    } else {
      *same = std::move(read);
    }
  }
}

void Reader::assignments(std::string_view name, std::vector<Assignment>& value, const Spec&) {
  const YAML::Node node = take(name);
  if (!node.IsDefined() || node.IsNull()) return;
  if (!node.IsMap()) reject(node, name, "a mapping");
  flatten(node, path_of(name), "", value);
}

std::string Reader::where(std::string_view name) const {
  const Level& level = stack_.back();
  if (!level.node.IsDefined() || !level.node.IsMap()) return "";
  for (const auto& entry : level.node) {
    if (entry.first.as<std::string>("") == name) {
      return source_.where(entry.first, path_of(name));
    }
  }
  return "";
}

bool Reader::begin_mapping(std::string_view name, std::vector<std::string>& names) {
  names.clear();
  if (!begin_section(name)) return false;
  for (const auto& entry : stack_.back().node) names.push_back(entry.first.as<std::string>(""));
  return true;
}

bool Reader::begin_section(std::string_view name) {
  const YAML::Node node = take(name);
  // `key:` with nothing after it is an empty mapping.
  if (!node.IsDefined() || node.IsNull()) return false;
  if (!node.IsMap()) reject(node, name, "a mapping");
  stack_.push_back({node, path_of(name), {}});
  return true;
}

void Reader::end_section() {
  reject_unknown(stack_.back());
  stack_.pop_back();
}

bool Reader::begin_list(std::string_view name, std::size_t& size) {
  const YAML::Node node = take(name);
  if (!node.IsDefined()) return false;
  require_sequence(node, name, "mappings");
  for (const YAML::Node& item : node) {
    if (!item.IsMap()) reject(item, name, "a list of mappings");
  }
  size = node.size();
  stack_.push_back({node, path_of(name), {}});
  return true;
}

void Reader::begin_element(std::size_t index) {
  const Level& list = stack_.back();
  const YAML::Node sequence = list.node;
  stack_.push_back({sequence[index], list.path + "[" + std::to_string(index) + "]", {}});
}

void Reader::end_list() {
  stack_.pop_back();
}

void Reader::reject_unknown(const Level& level) const {
  if (!level.node.IsDefined() || !level.node.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& entry : level.node) {
    const auto key = entry.first.as<std::string>("");
    const std::string path = level.path.empty() ? key : level.path + "." + key;
    if (!seen.insert(key).second) {
      throw Error(source_.where(entry.first, path) + ": key '" + path + "' stands here twice");
    }
    if (std::ranges::find(level.known, key) != level.known.end()) continue;
    const std::string_view near = nearest_name(key, level.known);
    const std::string hint = near.empty() ? "" : "; did you mean '" + std::string(near) + "'?";
    throw Error(source_.where(entry.first, path) + ": unknown key '" + path + "'" + hint);
  }
}

std::string_view nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  std::string_view best;
  std::size_t best_distance = name.size() / 2 + 2;
  std::vector<std::size_t> row;
  for (const std::string& candidate : candidates) {
    row.resize(candidate.size() + 1);
    for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= name.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j < row.size(); ++j) {
        const std::size_t substituted = diagonal + (name[i - 1] == candidate[j - 1] ? 0 : 1);
        diagonal = row[j];
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
      }
    }
    if (row.back() < best_distance) {
      best_distance = row.back();
      best = candidate;
    }
  }
  return best;
}

}  // namespace coop::config
