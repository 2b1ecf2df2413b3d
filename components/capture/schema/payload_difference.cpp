#include "capture/schema/payload_difference.hpp"

#include <cstring>

#include "capture/schema/cdr_walk.hpp"
#include "capture/schema/number_text.hpp"

namespace coop::capture {
namespace {

/// Follows the walk through the first payload with a cursor in the second.
class Comparison {
 public:
  Comparison(const MessageLayout& layout, std::span<const std::byte> second)
      : layout_(layout), second_(second) {}

  void begin_message(const FieldLayout& field, std::size_t index) {
    place_.push_back({&field, index});
    // The byte of a message without fields.
    if (is_open() && layout_.type_of(field).field_count == 0) second_.skip(1);
  }
  void end_message(const FieldLayout& /*field*/) { place_.pop_back(); }
  void begin_array(const FieldLayout& field, std::size_t count) { is_as_long(field, count); }
  void end_array(const FieldLayout& /*field*/) {}

  void text(const FieldLayout& field, std::size_t index, std::string_view value) {
    if (!is_open()) return;
    const std::string_view other = second_.text(field.string_bound);
    if (second_.failed() || other == value) return;
    std::string a;
    std::string b;
    append_json_string(a, value);
    append_json_string(b, other);
    found(field, index, a, b);
  }
  void number(const FieldLayout& field, const Number& value) {
    if (!is_open()) return;
    const Number other = second_.number(field.type);
    if (!second_.failed()) compare(field, kNoIndex, value, other);
  }
  void numbers(const FieldLayout& field, const NumberArray& values) {
    if (!is_as_long(field, values.size())) return;
    const NumberArray others = second_.numbers(field.type, values.size());
    if (second_.failed() || others.size() != values.size() || is_same_bytes(values, others)) return;
    for (std::size_t i = 0; i < values.size() && is_open(); ++i) {
      compare(field, i, values[i], others[i]);
    }
  }

  [[nodiscard]] std::optional<PayloadDifference> difference() && { return std::move(difference_); }
  [[nodiscard]] bool second_failed() const { return second_.failed(); }
  [[nodiscard]] CdrError second_error() const {
    CdrError error = second_.error();
    error.reason = "in the second: " + error.reason;
    return error;
  }

 private:
  [[nodiscard]] bool is_open() const { return !difference_ && !second_.failed(); }

  bool is_as_long(const FieldLayout& field, std::size_t count) {
    if (!is_open()) return false;
    if (field.array != FieldLayout::Array::kSequence) return true;
    const std::size_t other = second_.length(field.size, layout_.least_size(field));
    if (second_.failed() || other == count) return !second_.failed();
    found(field, kNoIndex, std::to_string(count) + " elements",
          std::to_string(other) + " elements");
    return false;
  }

  static bool is_same_bytes(const NumberArray& a, const NumberArray& b) {
    return a.is_swapped() == b.is_swapped() && !a.bytes().empty() &&
           std::memcmp(a.bytes().data(), b.bytes().data(), a.bytes().size()) == 0;
  }

  void compare(const FieldLayout& field, std::size_t index, const Number& a, const Number& b) {
    if (is_same(a, b)) return;
    std::string first;
    std::string second;
    append_number(first, a, TextStyle::kPlain);
    append_number(second, b, TextStyle::kPlain);
    found(field, index, first, second);
  }

  void found(const FieldLayout& field, std::size_t index, std::string first, std::string second) {
    place_.push_back({&field, index});
    difference_.emplace();
    for (const Place& place : place_) {
      std::string& path = difference_->path;
      path += (path.empty() ? "" : ".") + place.field->name;
      if (place.index != kNoIndex) path += "[" + std::to_string(place.index) + "]";
    }
    difference_->first = std::move(first);
    difference_->second = std::move(second);
    place_.pop_back();
  }

  struct Place {
    const FieldLayout* field;
    std::size_t index;
  };
  const MessageLayout& layout_;
  CdrCursor second_;
  std::vector<Place> place_;
  std::optional<PayloadDifference> difference_;
};

bool is_same_bytes(std::span<const std::byte> a, std::span<const std::byte> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size()) == 0);
}

}  // namespace

Result<std::optional<PayloadDifference>, CdrError> first_difference(
    const MessageLayout& layout, std::span<const std::byte> first,
    std::span<const std::byte> second) {
  if (is_same_bytes(first, second)) return std::optional<PayloadDifference>();
  Comparison comparison(layout, second);
  const auto read = walk(layout, first, comparison);
  if (!read) {
    CdrError error = read.error();
    error.reason = "in the first: " + error.reason;
    return fail(std::move(error));
  }
  if (comparison.second_failed()) return fail(comparison.second_error());
  return std::move(comparison).difference();
}

}  // namespace coop::capture
