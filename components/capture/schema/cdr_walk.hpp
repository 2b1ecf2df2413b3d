#pragma once
#include "capture/schema/cdr_cursor.hpp"

namespace coop::capture {

/// Index of a value that is no element of an array.
inline constexpr std::size_t kNoIndex = static_cast<std::size_t>(-1);

/// Walks through a payload in the order of its fields and tells a visitor what is there, with no
/// allocation and no copy. A visitor has
///
///   void begin_message(const FieldLayout&, std::size_t index);   // a field of message type, or
///   void end_message(const FieldLayout&);                        // an element of one; else
///   kNoIndex void begin_array(const FieldLayout&, std::size_t count);     // of messages or
///   strings void end_array(const FieldLayout&); void text(const FieldLayout&, std::size_t index,
///   std::string_view value); void number(const FieldLayout&, const Number& value); void
///   numbers(const FieldLayout&, const NumberArray& values);  // an array of numbers, whole bool
///   wants(const FieldLayout&);  // optional: false skips the field, quickly
///
/// What it was told before an error stands. No malformed payload makes more calls than it has
/// bytes, or reads beyond its end.
template <class Visitor>
class CdrWalker {
 public:
  CdrWalker(const MessageLayout& layout, std::span<const std::byte> payload, Visitor& visitor)
      : layout_(layout), cursor_(payload), visitor_(visitor) {}

  /// Number of bytes read, encapsulation included; what is behind them is padding of the writer's.
  Result<std::size_t, CdrError> run() {
    if (!cursor_.failed()) message(layout_.types().front());
    if (!cursor_.failed()) return cursor_.offset();
    CdrError error = cursor_.error();
    error.path = path_;
    return coop::fail(std::move(error));
  }

 private:
  using Array = FieldLayout::Array;

  void message(const TypeLayout& type) {
    if (type.field_count == 0) return cursor_.skip(1);
    for (const FieldLayout& field : layout_.fields(type)) {
      if (wants(field)) {
        visit(field);
      } else {
        skip(field);
      }
      if (cursor_.failed()) return note(field.name);
    }
  }

  [[nodiscard]] bool wants(const FieldLayout& field) {
    if constexpr (requires(Visitor & visitor) { visitor.wants(field); }) {
      return visitor_.wants(field);
    } else {
      return true;
    }
  }

  /// Elements of a field: 1 of a single value. kNoIndex after a failure.
  std::size_t count_of(const FieldLayout& field) {
    if (field.array == Array::kNone) return 1;
    if (field.array == Array::kSequence) return cursor_.length(field.size, least_size(field));
    if (field.size > cursor_.remaining() / least_size(field)) cursor_.fail("the payload ends");
    return field.size;
  }

  std::uint64_t least_size(const FieldLayout& field) const { return layout_.least_size(field); }

  void visit(const FieldLayout& field) {
    const std::size_t count = count_of(field);
    if (cursor_.failed()) return;
    if (field.array == Array::kNone) return visit_one(field, kNoIndex);
    if (field.type < Primitive::kString) {
      const NumberArray values = cursor_.numbers(field.type, count);
      if (!cursor_.failed()) visitor_.numbers(field, values);
      return;
    }
    visitor_.begin_array(field, count);
    for (std::size_t i = 0; i < count; ++i) {
      visit_one(field, i);
      if (cursor_.failed()) return note_index(i);
    }
    visitor_.end_array(field);
  }

  void visit_one(const FieldLayout& field, std::size_t index) {
    if (field.type == Primitive::kMessage) {
      visitor_.begin_message(field, index);
      message(layout_.type_of(field));
      if (!cursor_.failed()) visitor_.end_message(field);
    } else if (field.type == Primitive::kString) {
      const std::string_view value = cursor_.text(field.string_bound);
      if (!cursor_.failed()) visitor_.text(field, index, value);
    } else {
      const Number value = cursor_.number(field.type);
      if (!cursor_.failed()) visitor_.number(field, value);
    }
  }

  void skip(const FieldLayout& field) {
    const std::size_t count = count_of(field);
    if (cursor_.failed()) return;
    if (field.type < Primitive::kString) {
      cursor_.numbers(field.type, count);
    } else if (field.type == Primitive::kString) {
      for (std::size_t i = 0; i < count && !cursor_.failed(); ++i) cursor_.text(field.string_bound);
    } else {
      const TypeLayout& type = layout_.type_of(field);
      if (type.is_fixed()) return cursor_.skip(type, count);
      for (std::size_t i = 0; i < count && !cursor_.failed(); ++i) skip_message(type);
    }
  }

  void skip_message(const TypeLayout& type) {
    for (const FieldLayout& field : layout_.fields(type)) {
      if (cursor_.failed()) return;
      skip(field);
    }
  }

  /// The path of a failure is put together from its end.
  void note(const std::string& name) {
    path_ = name + (path_.empty() || path_.front() == '[' ? "" : ".") + path_;
  }
  void note_index(std::size_t index) {
    path_ = "[" + std::to_string(index) + "]" + (path_.empty() ? "" : ".") + path_;
  }

  const MessageLayout& layout_;
  CdrCursor cursor_;
  Visitor& visitor_;
  std::string path_;
};

/// See CdrWalker.
template <class Visitor>
Result<std::size_t, CdrError> walk(const MessageLayout& layout, std::span<const std::byte> payload,
                                   Visitor&& visitor) {
  return CdrWalker<std::remove_reference_t<Visitor>>(layout, payload, visitor).run();
}

}  // namespace coop::capture
