#include <algorithm>

#include "launcher/plan.hpp"

namespace coop::launcher {

void Variables::set(std::string name, std::string value) {
  values_.emplace_back(std::move(name), std::move(value));
}

std::string Variables::replace(std::string_view text, const std::string& where) const {
  std::string out;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t start = text.find("${", begin);
    out += text.substr(begin, start == std::string_view::npos ? start : start - begin);
    if (start == std::string_view::npos) return out;
    const std::size_t end = text.find('}', start);
    if (end == std::string_view::npos) {
      throw config::Error(where + ": '${' without '}' in '" + std::string(text) + "'");
    }
    const std::string name(text.substr(start + 2, end - start - 2));
    const auto found =
        std::ranges::find(values_, name, [](const auto& value) { return value.first; });
    if (found == values_.end()) {
      std::vector<std::string> names;
      for (const auto& value : values_) names.push_back(value.first);
      const std::string_view near = config::nearest_name(name, names);
      throw config::Error(where + ": unknown variable '${" + name + "}'" +
                          (near.empty() ? "" : "; did you mean '" + std::string(near) + "'?"));
    }
    out += found->second;
    begin = end + 1;
  }
}

}  // namespace coop::launcher
