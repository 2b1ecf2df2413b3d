#include "capture/schema/message_definition.hpp"

#include <algorithm>
#include <array>

namespace coop::capture {
namespace {

constexpr std::array<std::string_view, 14> kPrimitives{
    "bool",  "byte",   "char",  "int8",   "uint8",   "int16",   "uint16",
    "int32", "uint32", "int64", "uint64", "float32", "float64", "string"};

bool is_word(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

void append_comment(std::string& out, const std::string& comment) {
  if (!comment.empty()) out += "  # " + comment;
  out += '\n';
}

}  // namespace

bool is_primitive_type(std::string_view type) {
  return std::ranges::find(kPrimitives, type) != kPrimitives.end();
}

std::string short_type_name(std::string_view name) {
  const auto slash = name.find('/');
  const std::string_view package = name.substr(0, slash);
  std::string_view type = slash == std::string_view::npos ? "" : name.substr(slash + 1);
  if (type.starts_with("msg/")) type.remove_prefix(4);
  if (!is_word(package) || !is_word(type)) {
    throw DefinitionError("'" + std::string(name) + "' is no type name (package/msg/Type)");
  }
  return std::string(package) + "/" + std::string(type);
}

std::string long_type_name(std::string_view name) {
  std::string result = short_type_name(name);
  return result.replace(result.find('/'), 1, "/msg/");
}

std::string FieldDefinition::full_type() const {
  std::string result = type;
  if (string_bound > 0) result += "<=" + std::to_string(string_bound);
  if (array == Array::kFixed) result += "[" + std::to_string(size) + "]";
  if (array == Array::kSequence) {
    result += size > 0 ? "[<=" + std::to_string(size) + "]" : std::string("[]");
  }
  return result;
}

std::string to_text(const MessageDefinition& definition) {
  std::string out;
  for (const std::string& comment : definition.comments) out += "# " + comment + "\n";
  for (const ConstantDefinition& constant : definition.constants) {
    out += constant.type + " " + constant.name + "=" + constant.value;
    append_comment(out, constant.comment);
  }
  for (const FieldDefinition& field : definition.fields) {
    out += field.full_type() + " " + field.name;
    if (!field.default_value.empty()) out += " " + field.default_value;
    append_comment(out, field.comment);
  }
  return out;
}

std::string to_ros2msg(const std::vector<const MessageDefinition*>& definitions) {
  std::string out;
  for (const MessageDefinition* definition : definitions) {
    if (definition != definitions.front()) {
      out += std::string(80, '=') + "\nMSG: " + definition->name + "\n";
    }
    out += to_text(*definition);
  }
  return out;
}

}  // namespace coop::capture
