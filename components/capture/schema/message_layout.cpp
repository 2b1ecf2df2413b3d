#include "capture/schema/message_layout.hpp"

#include <algorithm>

namespace coop::capture {
namespace {

struct PrimitiveInfo {
  std::string_view name;
  std::size_t width;
};
constexpr std::array<PrimitiveInfo, 15> kPrimitives{{{"bool", 1},
                                                     {"byte", 1},
                                                     {"char", 1},
                                                     {"int8", 1},
                                                     {"uint8", 1},
                                                     {"int16", 2},
                                                     {"uint16", 2},
                                                     {"int32", 4},
                                                     {"uint32", 4},
                                                     {"int64", 8},
                                                     {"uint64", 8},
                                                     {"float32", 4},
                                                     {"float64", 8},
                                                     {"string", 0},
                                                     {"message", 0}}};

/// Sizes that no payload reaches stay there instead of overflowing.
constexpr std::uint64_t kHuge = std::uint64_t{1} << 60;

std::uint64_t added(std::uint64_t a, std::uint64_t b) {
  return std::min(kHuge, a + b);
}

std::uint64_t multiplied(std::uint64_t a, std::uint64_t b) {
  return a != 0 && b > kHuge / a ? kHuge : a * b;
}

/// Offset behind `count` elements of a fixed type that begin at an offset.
std::uint64_t behind(const TypeLayout& element, std::uint64_t count, std::uint64_t at) {
  // Offsets modulo 8 run into a cycle within 8 elements; 840 is a multiple of every such cycle.
  constexpr std::uint64_t kCycle = 840;
  const auto step = [&](std::uint64_t elements) {
    for (std::uint64_t i = 0; i < elements; ++i) at = added(at, element.advance[at % 8]);
  };
  const std::uint64_t first = std::min<std::uint64_t>(count, 8);
  step(first);
  const std::uint64_t cycles = (count - first) / kCycle;
  if (cycles > 0) {
    const std::uint64_t begin = at;
    step(kCycle);
    at = added(at, multiplied(cycles - 1, at - begin));
  }
  step((count - first) % kCycle);
  return at;
}

Primitive primitive_of(std::string_view type) {
  const auto found = std::ranges::find(kPrimitives, type, &PrimitiveInfo::name);
  if (found == kPrimitives.end()) return Primitive::kMessage;
  return static_cast<Primitive>(found - kPrimitives.begin());
}

}  // namespace

std::size_t width_of(Primitive type) {
  return kPrimitives[static_cast<std::size_t>(type)].width;
}

std::string_view name_of(Primitive type) {
  return kPrimitives[static_cast<std::size_t>(type)].name;
}

MessageLayout::MessageLayout(std::string_view name, std::string_view ros2msg) {
  const auto definitions = parse_ros2msg(name, ros2msg);
  add(definitions, definitions.front().name, 0);
}

std::uint32_t MessageLayout::add(const std::vector<MessageDefinition>& definitions,
                                 std::string_view name, std::size_t depth) {
  if (depth >= kMaxDepth) {
    throw DefinitionError(std::string(name) + " is nested too deeply, or within itself");
  }
  const auto known = std::ranges::find(types_, name, &TypeLayout::name);
  // A type is measured once all it is made of is: one met before that contains itself.
  if (known != types_.end() && known->least_size > 0) {
    return static_cast<std::uint32_t>(known - types_.begin());
  }
  if (known != types_.end()) throw DefinitionError(std::string(name) + " contains itself");
  const auto definition = std::ranges::find(definitions, name, &MessageDefinition::name);
  if (definition == definitions.end())
    throw DefinitionError("no definition of " + std::string(name));

  const auto index = types_.size();
  types_.push_back({.name = definition->name});
  std::vector<FieldLayout> fields;
  for (const FieldDefinition& field : definition->fields) {
    FieldLayout layout{.name = field.name,
                       .type = primitive_of(field.type),
                       .array = field.array,
                       .size = field.size,
                       .string_bound = field.string_bound};
    if (layout.type == Primitive::kMessage) {
      layout.message = add(definitions, field.type, depth + 1);
    }
    fields.push_back(std::move(layout));
  }
  TypeLayout& type = types_[index];
  type.first_field = static_cast<std::uint32_t>(fields_.size());
  type.field_count = static_cast<std::uint32_t>(fields.size());
  std::ranges::move(fields, std::back_inserter(fields_));
  measure(type);
  return static_cast<std::uint32_t>(index);
}

std::uint64_t MessageLayout::least_size(const FieldLayout& field) const {
  if (field.type == Primitive::kMessage) return type_of(field).least_size;
  return field.type == Primitive::kString ? 4 : width_of(field.type);
}

void MessageLayout::measure(TypeLayout& type) const {
  // A message without fields is one byte on the wire: an IDL struct needs a member.
  if (type.field_count == 0) {
    type.least_size = 1;
    type.advance.fill(1);
    return;
  }
  bool fixed = true;
  for (const FieldLayout& field : fields(type)) {
    const bool sequence = field.array == FieldLayout::Array::kSequence;
    const std::uint64_t count = field.array == FieldLayout::Array::kFixed ? field.size : 1;
    type.least_size = added(type.least_size, sequence ? 4 : multiplied(count, least_size(field)));
    fixed = fixed && !sequence && field.type != Primitive::kString &&
            (field.type != Primitive::kMessage || type_of(field).is_fixed());
  }
  if (!fixed) return;
  for (std::uint64_t start = 0; start < 8; ++start) {
    std::uint64_t at = start;
    for (const FieldLayout& field : fields(type)) {
      const std::uint64_t count = field.array == FieldLayout::Array::kFixed ? field.size : 1;
      if (field.type != Primitive::kMessage) {
        const std::uint64_t width = width_of(field.type);
        at = added((at + width - 1) & ~(width - 1), multiplied(count, width));
        continue;
      }
      at = behind(type_of(field), count, at);
    }
    type.advance[start] = at - start;
  }
}

}  // namespace coop::capture
