#include "core/csv.hpp"

#include <algorithm>
#include <stdexcept>

namespace coop {
namespace {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\n\r") == std::string::npos) return field;
  std::string out = "\"";
  for (const char c : field) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

/// Splits text into records, character by character.
class Splitter {
 public:
  void take(char c) {
    if (in_quotes_) {
      // A quote within quotes is doubled: the second one opens them again.
      if (c == '"') {
        in_quotes_ = false;
        closed_ = true;
      } else {
        field_ += c;
      }
      return;
    }
    if (c == '"') {
      if (closed_) field_ += '"';
      in_quotes_ = true;
    } else if (c == ',') {
      end_field();
    } else if (c == '\n') {
      end_field();
      records_.push_back(std::move(record_));
      record_.clear();
    } else if (c != '\r') {
      field_ += c;
    }
    closed_ = false;
  }
  [[nodiscard]] bool in_quotes() const { return in_quotes_; }
  [[nodiscard]] std::vector<std::vector<std::string>>& records() { return records_; }

 private:
  void end_field() {
    record_.push_back(std::move(field_));
    field_.clear();
  }

  std::vector<std::vector<std::string>> records_;
  std::vector<std::string> record_;
  std::string field_;
  bool in_quotes_ = false;
  bool closed_ = false;
};

}  // namespace

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += ',';
    line += quoted(fields[i]);
  }
  return line + '\n';
}

std::size_t CsvTable::column(std::string_view name) const {
  const auto found = std::ranges::find(columns, name);
  if (found == columns.end()) {
    throw std::runtime_error("no column '" + std::string(name) + "' in the table");
  }
  return static_cast<std::size_t>(found - columns.begin());
}

CsvTable parse_csv(std::string_view text) {
  Splitter splitter;
  for (const char c : text) splitter.take(c);
  if (splitter.in_quotes()) throw std::runtime_error("a quote is left open");
  CsvTable table;
  auto& records = splitter.records();
  if (records.empty()) return table;
  table.columns = std::move(records.front());
  for (std::size_t i = 1; i < records.size(); ++i) {
    if (records[i].size() != table.columns.size()) {
      throw std::runtime_error("line " + std::to_string(i + 1) + " has " +
                               std::to_string(records[i].size()) + " fields, not " +
                               std::to_string(table.columns.size()));
    }
    table.rows.push_back(std::move(records[i]));
  }
  return table;
}

}  // namespace coop
