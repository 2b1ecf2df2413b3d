#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace coop {

/// One line of comma-separated values with its line feed (RFC 4180: a field that holds a comma, a
/// quote or a line feed is quoted).
[[nodiscard]] std::string csv_line(const std::vector<std::string>& fields);

/// A table with a header line.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`

  /// Place of a column; throws std::runtime_error naming it where there is none.
  [[nodiscard]] std::size_t column(std::string_view name) const;
};

/// Throws std::runtime_error for a row whose length is not the header's, or a quote left open. A
/// last line without line feed is one that its writer did not finish, and is left out.
[[nodiscard]] CsvTable parse_csv(std::string_view text);

}  // namespace coop
