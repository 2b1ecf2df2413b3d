#include "capture/schema/csv_columns.hpp"

#include <algorithm>

#include "capture/schema/cdr_walk.hpp"
#include "capture/schema/number_text.hpp"

namespace coop::capture {
namespace {

constexpr const char* kTooMany = "more columns than a table can have: shorten the arrays";

}  // namespace

/// Follows a walk through the nodes: at each level the place among the siblings, which come in
/// their order and are all visited.
class CsvColumns::Measure {
 public:
  explicit Measure(CsvColumns& columns) : nodes_(columns.nodes_) {
    levels_.push_back({&columns.roots_, 0});
  }

  void begin_message(const FieldLayout& field, std::size_t index) {
    Node& node = index == kNoIndex ? next() : *arrays_.back();
    if (field.array == FieldLayout::Array::kNone) node.longest = 1;
    levels_.push_back({&node.children, 0});
  }
  void end_message(const FieldLayout& /*field*/) { levels_.pop_back(); }
  void begin_array(const FieldLayout& /*field*/, std::size_t count) {
    Node& node = next();
    note(node, count);
    arrays_.push_back(&node);
  }
  void end_array(const FieldLayout& /*field*/) { arrays_.pop_back(); }
  void text(const FieldLayout& /*field*/, std::size_t index, std::string_view /*value*/) {
    if (index == kNoIndex) note(next(), 1);
  }
  void number(const FieldLayout& /*field*/, const Number& /*value*/) { note(next(), 1); }
  void numbers(const FieldLayout& /*field*/, const NumberArray& values) {
    note(next(), values.size());
  }

 private:
  struct Level {
    const std::vector<std::size_t>* nodes;
    std::size_t at;
  };
  Node& next() {
    Level& level = levels_.back();
    return nodes_[(*level.nodes)[level.at++]];
  }
  static void note(Node& node, std::size_t count) { node.longest = std::max(node.longest, count); }

  std::vector<Node>& nodes_;
  std::vector<Level> levels_;
  std::vector<Node*> arrays_;
};

/// As Measure, with the first column of each level.
class CsvColumns::Fill {
 public:
  explicit Fill(CsvColumns& columns) : nodes_(columns.nodes_), row_(columns.row_) {
    levels_.push_back({&columns.roots_, 0, 0});
  }

  void begin_message(const FieldLayout& /*field*/, std::size_t index) {
    if (index == kNoIndex) {
      const std::size_t column = levels_.back().column;
      const Node& node = next();
      levels_.push_back({&node.children, 0, column});
    } else {
      const Array& array = arrays_.back();
      const bool shown = array.column != kHidden && index < array.node->shown;
      levels_.push_back(
          {&array.node->children, 0, shown ? array.column + index * array.node->stride : kHidden});
    }
  }
  void end_message(const FieldLayout& /*field*/) { levels_.pop_back(); }
  void begin_array(const FieldLayout& /*field*/, std::size_t count) {
    const std::size_t column = levels_.back().column;
    const Node& node = next();
    put_length(node, column, count);
    arrays_.push_back({&node, column});
  }
  void end_array(const FieldLayout& /*field*/) { arrays_.pop_back(); }
  void text(const FieldLayout& /*field*/, std::size_t index, std::string_view value) {
    if (index == kNoIndex) {
      const std::size_t column = levels_.back().column;
      next();
      if (column != kHidden) row_[column] = value;
    } else if (arrays_.back().column != kHidden && index < arrays_.back().node->shown) {
      row_[arrays_.back().column + index] = value;
    }
  }
  void number(const FieldLayout& /*field*/, const Number& value) {
    const std::size_t column = levels_.back().column;
    next();
    if (column != kHidden) append_number(row_[column], value, TextStyle::kPlain);
  }
  void numbers(const FieldLayout& /*field*/, const NumberArray& values) {
    const std::size_t column = levels_.back().column;
    const Node& node = next();
    if (column == kHidden) return;
    put_length(node, column, values.size());
    for (std::size_t i = 0; i < std::min(values.size(), node.shown); ++i) {
      append_number(row_[column + i], values[i], TextStyle::kPlain);
    }
  }

 private:
  static constexpr std::size_t kHidden = static_cast<std::size_t>(-1);
  struct Level {
    const std::vector<std::size_t>* nodes;
    std::size_t at;
    std::size_t column;
  };
  struct Array {
    const Node* node;
    std::size_t column;
  };
  const Node& next() {
    Level& level = levels_.back();
    const Node& node = nodes_[(*level.nodes)[level.at++]];
    if (level.column != kHidden) level.column += node.width;
    return node;
  }
  void put_length(const Node& node, std::size_t column, std::size_t count) {
    if (column == kHidden || node.shown == node.longest) return;
    row_[column + node.shown * node.stride] = std::to_string(count);
  }

  std::vector<Node>& nodes_;
  std::vector<std::string>& row_;
  std::vector<Level> levels_;
  std::vector<Array> arrays_;
};

CsvColumns::CsvColumns(const MessageLayout& layout, CsvOptions options)
    : layout_(layout), options_(options) {
  roots_ = expand(layout.types().front());
}

std::vector<std::size_t> CsvColumns::expand(const TypeLayout& type) {
  std::vector<std::size_t> result;
  for (const FieldLayout& field : layout_.fields(type)) {
    if (nodes_.size() >= kMaxColumns) throw DefinitionError(kTooMany);
    const std::size_t node = nodes_.size();
    nodes_.push_back({.field = &field});
    result.push_back(node);
    if (field.type == Primitive::kMessage) {
      auto children = expand(layout_.type_of(field));
      nodes_[node].children = std::move(children);
    }
  }
  return result;
}

Result<void, CdrError> CsvColumns::measure(std::span<const std::byte> payload) {
  const auto read = walk(layout_, payload, Measure(*this));
  if (!read) return fail(read.error());
  return {};
}

void CsvColumns::settle() {
  std::size_t columns = 0;
  for (const std::size_t root : roots_) columns += lay_out(nodes_[root]);
  if (columns > kMaxColumns) throw DefinitionError(kTooMany);
  row_.resize(columns);
}

std::size_t CsvColumns::lay_out(Node& node) {
  if (node.field->type == Primitive::kMessage) {
    node.stride = 0;
    for (const std::size_t child : node.children) node.stride += lay_out(nodes_[child]);
  }
  const bool single = node.field->array == FieldLayout::Array::kNone;
  if (single) node.longest = 1;
  node.shown = single ? 1 : std::min(node.longest, options_.max_elements);
  if (node.stride > 0 && node.shown > kMaxColumns / node.stride) throw DefinitionError(kTooMany);
  node.width = node.shown * node.stride + (node.shown == node.longest ? 0 : 1);
  return node.width;
}

std::vector<std::string> CsvColumns::names() const {
  std::vector<std::string> result;
  for (const std::size_t root : roots_) name(nodes_[root], "", result);
  return result;
}

void CsvColumns::name(const Node& node, const std::string& prefix,
                      std::vector<std::string>& out) const {
  const std::string path = prefix + node.field->name;
  const bool single = node.field->array == FieldLayout::Array::kNone;
  for (std::size_t i = 0; i < node.shown; ++i) {
    const std::string element = single ? path : path + "[" + std::to_string(i) + "]";
    if (node.field->type != Primitive::kMessage) out.push_back(element);
    for (const std::size_t child : node.children) name(nodes_[child], element + ".", out);
  }
  if (node.shown != node.longest) out.push_back(path + ".length");
}

Result<const std::vector<std::string>*, CdrError> CsvColumns::row(
    std::span<const std::byte> payload) {
  for (std::string& field : row_) field.clear();
  const auto read = walk(layout_, payload, Fill(*this));
  if (!read) return fail(read.error());
  return &row_;
}

}  // namespace coop::capture
