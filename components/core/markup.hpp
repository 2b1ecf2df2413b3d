#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace coop {

/// Text for HTML and SVG: what would be read as markup is written as entities.
[[nodiscard]] std::string escape_markup(std::string_view text);

/// A table of texts, a row of headings first.
[[nodiscard]] std::string html_table(const std::vector<std::string>& headings,
                                     const std::vector<std::vector<std::string>>& rows);

/// A self-contained page in the style of all of Coop's reports (classes `good` and `bad`).
[[nodiscard]] std::string html_page(std::string_view title, std::string_view body);

}  // namespace coop
