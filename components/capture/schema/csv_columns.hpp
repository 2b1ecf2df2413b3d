#pragma once
#include <limits>
#include <string>
#include <vector>

#include "capture/schema/cdr_cursor.hpp"

namespace coop::capture {

struct CsvOptions {
  /// Of arrays that are longer anywhere, only so many elements have columns; a column `name.length`
  /// then says how many there are.
  std::size_t max_elements = std::numeric_limits<std::size_t>::max();
};

/// The columns of a topic as a table: a column a number or string, named by its path
/// (`pose.position.x`, `ranges[17]`). Arrays have as many columns as the longest one needs, so all
/// messages are measured first:
///
///   CsvColumns columns(layout, options);
///   for each payload: columns.measure(payload);
///   columns.settle();
///   columns.names(), then for each payload: columns.row(payload)
///
/// Elements that a message does not have are empty fields.
class CsvColumns {
 public:
  static constexpr std::size_t kMaxColumns = 1'000'000;

  /// Throws DefinitionError for a type whose fields alone are more than kMaxColumns. The layout
  /// must outlive it.
  CsvColumns(const MessageLayout& layout, CsvOptions options);

  [[nodiscard]] Result<void, CdrError> measure(std::span<const std::byte> payload);
  /// Lays the columns out. Throws DefinitionError where they would be more than kMaxColumns.
  void settle();

  [[nodiscard]] std::vector<std::string> names() const;
  /// As many fields as there are names; valid until the next call.
  [[nodiscard]] Result<const std::vector<std::string>*, CdrError> row(
      std::span<const std::byte> payload);

 private:
  /// A field where it stands: the same type at two places is two nodes.
  struct Node {
    const FieldLayout* field;
    std::vector<std::size_t> children{};  ///< of a message: nodes of its fields, in order
    std::size_t longest = 0;              ///< elements of the longest array; 1 of a single value
    std::size_t shown = 0;                ///< of them, with columns
    std::size_t stride = 1;               ///< columns an element
    std::size_t width = 0;                ///< columns in all
  };
  class Measure;
  class Fill;

  std::vector<std::size_t> expand(const TypeLayout& type);
  std::size_t lay_out(Node& node);
  void name(const Node& node, const std::string& prefix, std::vector<std::string>& out) const;

  const MessageLayout& layout_;
  CsvOptions options_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> roots_;
  std::vector<std::string> row_;
};

}  // namespace coop::capture
