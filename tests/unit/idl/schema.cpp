#include "unit/idl/schema.hpp"

#include "capture/schema/idl_parser.hpp"
#include "core/atomic_file.hpp"

namespace coop::test {
namespace {

using capture::FieldDefinition;

std::string array_of(const FieldDefinition& field) {
  if (field.array == FieldDefinition::Array::kSequence) return "[]";
  return field.array == FieldDefinition::Array::kFixed ? "[" + std::to_string(field.size) + "]"
                                                       : "";
}

Message fields_of(const capture::MessageDefinition& definition) {
  Message message;
  message.final_struct = definition.is_final;
  for (const FieldDefinition& field : definition.fields) {
    message.fields.push_back({.type = field.type,
                              .array = array_of(field),
                              .name = field.name,
                              .default_value = field.default_value,
                              .key = field.key});
  }
  return message;
}

}  // namespace

Message parse_msg(const std::string& package, const std::string& text) {
  return fields_of(capture::parse_message_definition(package + "/Message", text));
}

Message parse_idl(const std::string& text) {
  return fields_of(capture::parse_idl("package/Message", text));
}

Schema load_idl(const std::filesystem::path& folder) {
  Schema schema;
  for (const auto& [name, definition] : capture::load_idl(folder)) {
    schema[name] = fields_of(definition);
  }
  return schema;
}

std::string read_text(const std::filesystem::path& file) {
  return read_file(file);
}

}  // namespace coop::test
