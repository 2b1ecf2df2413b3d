#pragma once
#include <string>
#include <string_view>

namespace coop {

/// Text for HTML and SVG: what would be read as markup is written as entities.
[[nodiscard]] std::string escape_markup(std::string_view text);

/// A self-contained page in the style of all of Coop's reports (classes `good` and `bad`).
[[nodiscard]] std::string html_page(std::string_view title, std::string_view body);

}  // namespace coop
