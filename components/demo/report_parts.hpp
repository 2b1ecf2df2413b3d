#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "demo/record.hpp"

/// What the reports of all demos are made of.
namespace coop::demo {

/// An image within the page itself.
[[nodiscard]] std::string image_tag(const std::string& png, std::string_view alt);
/// Time, distance, errors, collisions.
[[nodiscard]] std::string figures_table(const Record& record);
/// What became of each target; `target` is what they are called.
[[nodiscard]] std::string target_table(const Record& record, std::string_view name);
[[nodiscard]] nlohmann::ordered_json to_json(const Record& record);

}  // namespace coop::demo
