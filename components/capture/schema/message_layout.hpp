#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture/schema/message_definition.hpp"

namespace coop::capture {

enum class Primitive : std::uint8_t {
  kBool,
  kByte,  ///< octet; shown as a number
  kChar,  ///< ROS 2's char is a uint8
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64,
  kString,
  kMessage,
};

/// Bytes of a number, which are its alignment too (XCDR1); 0 for strings and messages.
[[nodiscard]] std::size_t width_of(Primitive type);
/// "uint8"; "message" for kMessage.
[[nodiscard]] std::string_view name_of(Primitive type);

struct FieldLayout {
  using Array = FieldDefinition::Array;

  std::string name;
  Primitive type = Primitive::kUint8;
  Array array = Array::kNone;
  std::uint32_t size = 0;          ///< of a fixed array; bound of a sequence, 0: none
  std::uint32_t string_bound = 0;  ///< 0: none
  std::uint32_t message = 0;       ///< of kMessage: index of its type in the layout
  bool operator==(const FieldLayout&) const = default;
};

struct TypeLayout {
  std::string name;  ///< "package/Type"
  std::uint32_t first_field = 0;
  std::uint32_t field_count = 0;
  std::uint64_t least_size = 0;  ///< bytes that every such message has, padding left out
  /// Of a type without strings and sequences: bytes from an offset of 0 .. 7 (modulo 8) to its end,
  /// padding before the first field included. Zeros for all others.
  std::array<std::uint64_t, 8> advance{};
  bool operator==(const TypeLayout&) const = default;

  [[nodiscard]] bool is_fixed() const { return advance[0] > 0; }
};

/// How a message lies in its bytes, as flat tables: all fields of all types in one list, the type
/// of a field by index. What CDR decoding is driven by (cdr_walk.hpp).
class MessageLayout {
 public:
  /// From definition text in schema encoding `ros2msg`. Throws DefinitionError: text that cannot be
  /// read, a type that is missing, one that contains itself, nesting deeper than kMaxDepth.
  MessageLayout(std::string_view name, std::string_view ros2msg);

  static constexpr std::size_t kMaxDepth = 40;

  /// "package/Type"
  [[nodiscard]] const std::string& name() const { return types_.front().name; }
  /// Type 0 is the message itself.
  [[nodiscard]] const std::vector<TypeLayout>& types() const { return types_; }
  [[nodiscard]] std::span<const FieldLayout> fields(const TypeLayout& type) const {
    return std::span(fields_).subspan(type.first_field, type.field_count);
  }
  [[nodiscard]] const TypeLayout& type_of(const FieldLayout& field) const {
    return types_[field.message];
  }
  /// Bytes that every element of the field has.
  [[nodiscard]] std::uint64_t least_size(const FieldLayout& field) const;

  /// Equal names, types and order; constants and comments do not count.
  bool operator==(const MessageLayout&) const = default;

 private:
  std::uint32_t add(const std::vector<MessageDefinition>& definitions, std::string_view name,
                    std::size_t depth);
  void measure(TypeLayout& type) const;

  std::vector<TypeLayout> types_;
  std::vector<FieldLayout> fields_;
};

}  // namespace coop::capture
