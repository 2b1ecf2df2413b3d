#include "capture/traffic/topic_names.hpp"

#include <algorithm>
#include <regex>
#include <stdexcept>

#include "capture/schema/definitions.hpp"

namespace coop::capture {
namespace {

constexpr std::string_view kTopicPrefix = "rt/";
constexpr std::string_view kRegex = "re:";

std::string_view without_slash(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  return name;
}

/// Backtracks to the last star only: linear but for pathological patterns.
bool glob(std::string_view pattern, std::string_view text) {
  std::size_t p = 0;
  std::size_t t = 0;
  std::size_t star = std::string_view::npos;
  std::size_t resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::regex regex_of(std::string_view pattern) {
  try {
    return std::regex(std::string(pattern));
  } catch (const std::regex_error& problem) {
    throw std::invalid_argument("'re:" + std::string(pattern) +
                                "' is no regular expression: " + problem.what());
  }
}

}  // namespace

std::string shown_topic(std::string_view wire_name) {
  if (!wire_name.starts_with(kTopicPrefix)) return std::string(wire_name);
  return "/" + std::string(wire_name.substr(kTopicPrefix.size()));
}

std::string wire_topic(std::string_view shown_name) {
  if (!shown_name.starts_with('/')) return std::string(shown_name);
  return std::string(kTopicPrefix) + std::string(shown_name.substr(1));
}

std::string shown_type(std::string_view dds_type) {
  return ros2_type_of_dds(dds_type).value_or(std::string(dds_type));
}

std::string dds_type(std::string_view shown_type) {
  constexpr std::string_view kMiddle = "/msg/";
  const auto middle = shown_type.find(kMiddle);
  if (middle == std::string_view::npos) return std::string(shown_type);
  return std::string(shown_type.substr(0, middle)) +
         "::msg::dds_::" + std::string(shown_type.substr(middle + kMiddle.size())) + "_";
}

bool matches(std::string_view pattern, std::string_view shown_name) {
  if (pattern.starts_with(kRegex)) {
    const std::regex expression = regex_of(pattern.substr(kRegex.size()));
    const std::string name(shown_name);
    return std::regex_match(name, expression) ||
           std::regex_match(std::string(without_slash(name)), expression);
  }
  return glob(without_slash(pattern), without_slash(shown_name));
}

bool TopicSelection::wants(std::string_view shown_name) const {
  const auto is_matched = [&](const std::string& pattern) { return matches(pattern, shown_name); };
  return (topics.empty() || std::ranges::any_of(topics, is_matched)) &&
         std::ranges::none_of(exclude, is_matched);
}

void TopicSelection::validate() const {
  for (const auto* patterns : {&topics, &exclude}) {
    for (const std::string& pattern : *patterns) {
      if (pattern.empty()) throw std::invalid_argument("an empty pattern matches no topic");
      (void)matches(pattern, "");
    }
  }
}

}  // namespace coop::capture
