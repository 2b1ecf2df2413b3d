#include "experiments/casma/tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/csv.hpp"
#include "core/markup.hpp"

namespace coop::casma {

std::string as_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (const auto& field : table.header) widths.push_back(field.size());
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  const auto line = [&](const std::vector<std::string>& fields) {
    std::string out;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      out += fmt::format("{}{:<{}}", i == 0 ? "  " : "  ", fields[i], widths[i]);
    }
    out.erase(out.find_last_not_of(' ') + 1);
    return out + "\n";
  };
  std::string out = table.title + "\n" + line(table.header);
  for (const auto& row : table.rows) out += line(row);
  return out;
}

std::string as_html(const Table& table) {
  std::string out = "<h3>" + escape_markup(table.title) + "</h3>\n";
  if (!table.note.empty()) out += "<p>" + escape_markup(table.note) + "</p>\n";
  return out + html_table(table.header, table.rows);
}

std::string as_csv(const Table& table) {
  std::string out = csv_line(table.header);
  for (const auto& row : table.rows) out += csv_line(row);
  return out;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::vector<Table> all_tables(const Findings& findings) {
  return {rosenbrock_table(findings), rosenbrock_places(findings), published_table(findings),
          plans_table(findings),      savings_table(findings),     moving_table(findings),
          pilot_table(findings)};
}

}  // namespace coop::casma
