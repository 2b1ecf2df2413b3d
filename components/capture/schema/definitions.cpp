#include "capture/schema/definitions.hpp"

#include <algorithm>

#include "capture/schema/definitions_table.hpp"

namespace coop::capture {
namespace {

bool is_same_type(std::string_view long_name, std::string_view name) {
  if (long_name == name) return true;
  const auto slash = name.find('/');
  return slash != std::string_view::npos && long_name.starts_with(name.substr(0, slash + 1)) &&
         long_name.substr(slash + 1) == "msg/" + std::string(name.substr(slash + 1));
}

}  // namespace

std::optional<std::string_view> ros2msg_definition(std::string_view name) {
  const auto table = definitions_table();
  const auto found = std::ranges::find_if(table, [name](const KnownDefinition& definition) {
    return is_same_type(definition.name, name);
  });
  if (found == table.end()) return std::nullopt;
  return found->text;
}

std::vector<std::string_view> ros2msg_names() {
  std::vector<std::string_view> names;
  for (const KnownDefinition& definition : definitions_table()) names.push_back(definition.name);
  return names;
}

std::optional<std::string> ros2_type_of_dds(std::string_view dds_name) {
  static constexpr std::string_view kMiddle = "::msg::dds_::";
  const auto middle = dds_name.find(kMiddle);
  if (middle == std::string_view::npos || middle == 0 || !dds_name.ends_with('_')) {
    return std::nullopt;
  }
  std::string_view type = dds_name.substr(middle + kMiddle.size());
  type.remove_suffix(1);
  if (type.empty()) return std::nullopt;
  return std::string(dds_name.substr(0, middle)) + "/msg/" + std::string(type);
}

}  // namespace coop::capture
