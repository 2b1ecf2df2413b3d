#include <algorithm>

#include "launcher/plan.hpp"

namespace coop::launcher {
namespace {

constexpr std::string_view kOpen = "${";

/// The name where `text` is one variable and nothing else.
std::string_view only_variable(std::string_view text) {
  if (!text.starts_with(kOpen) || text.find('}') != text.size() - 1) return {};
  return text.substr(kOpen.size(), text.size() - kOpen.size() - 1);
}

}  // namespace

void Variables::set(std::string name, std::string text, std::string in_yaml) {
  variables_.push_back({std::move(name), std::move(text), std::move(in_yaml)});
}

const Variables::Variable& Variables::find(std::string_view name, const std::string& where) const {
  const auto found = std::ranges::find(variables_, name, &Variable::name);
  if (found != variables_.end()) return *found;
  std::vector<std::string> names;
  for (const Variable& variable : variables_) names.push_back(variable.name);
  const std::string_view near = config::nearest_name(name, names);
  throw config::Error(where + ": unknown variable '${" + std::string(name) + "}'" +
                      (near.empty() ? "" : "; did you mean '" + std::string(near) + "'?"));
}

std::string Variables::replace(std::string_view text, const std::string& where) const {
  std::string out;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t start = text.find(kOpen, begin);
    out += text.substr(begin, start == std::string_view::npos ? start : start - begin);
    if (start == std::string_view::npos) return out;
    const std::size_t end = text.find('}', start);
    if (end == std::string_view::npos) {
      throw config::Error(where + ": '${' without '}' in '" + std::string(text) + "'");
    }
    out += find(text.substr(start + kOpen.size(), end - start - kOpen.size()), where).text;
    begin = end + 1;
  }
}

std::string Variables::replace_in_yaml(const config::Assignment& value,
                                       const std::string& where) const {
  const std::string_view name = only_variable(value.text);
  return name.empty() ? replace(value.value, where) : find(name, where).in_yaml;
}

}  // namespace coop::launcher
