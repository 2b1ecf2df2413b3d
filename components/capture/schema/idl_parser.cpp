#include "capture/schema/idl_parser.hpp"

#include <algorithm>
#include <regex>

#include "core/atomic_file.hpp"

namespace coop::capture {
namespace {

using Array = FieldDefinition::Array;

std::string type_from_idl(const std::string& type) {
  static const std::map<std::string, std::string> kNames{
      {"double", "float64"}, {"float", "float32"}, {"boolean", "bool"}, {"octet", "byte"}};
  const auto name = kNames.find(type);
  if (name != kNames.end()) return name->second;
  if (type != "char" && is_primitive_type(type)) return type;
  static const std::regex kScoped(R"((\w+)::msg::(\w+))");
  std::smatch match;
  if (!std::regex_match(type, match, kScoped)) throw DefinitionError("IDL type " + type);
  return match[1].str() + "/" + match[2].str();
}

std::uint32_t size_of(const std::ssub_match& text) {
  if (!text.matched) return 0;
  const unsigned long value = std::stoul(text.str());
  if (value == 0 || value > UINT32_MAX) throw DefinitionError("size " + text.str());
  return static_cast<std::uint32_t>(value);
}

FieldDefinition field_from_idl(const std::string& line) {
  // 1 key, 2 default, 3 sequence, 4 type, 5 bound of a string, 6 bound of a sequence, 7 name, 8
  // size
  static const std::regex kField(
      R"(\s*(@key )?(?:@default\(value=([^)]*)\) )?(?:(sequence<)\s*)?([\w:]+)(?:<(\d+)>)?)"
      R"((?:\s*,\s*(\d+))?\s*>?\s*(\w+)(?:\[(\d+)\])?;)");
  std::smatch match;
  const auto closing = std::ranges::count(line, '>');
  const auto opening = std::ranges::count(line, '<');
  if (!std::regex_match(line, match, kField) || closing != opening ||
      (match[3].matched && match[8].matched) || (!match[3].matched && match[6].matched)) {
    throw DefinitionError("IDL field: " + line);
  }
  FieldDefinition field{.type = type_from_idl(match[4]),
                        .string_bound = size_of(match[5]),
                        .size = match[3].matched ? size_of(match[6]) : size_of(match[8]),
                        .name = match[7],
                        .default_value = match[2],
                        .key = match[1].matched};
  if (match[3].matched) field.array = Array::kSequence;
  if (match[8].matched) field.array = Array::kFixed;
  if (field.string_bound > 0 && field.type != "string") throw DefinitionError("IDL field: " + line);
  return field;
}

class IdlText {
 public:
  explicit IdlText(std::string_view name) { message_.name = name; }

  void take(std::string line) {
    std::string comment;
    if (const auto at = line.find("//"); at != std::string::npos) {
      comment = std::regex_replace(line.substr(at + 2), std::regex(R"(^\s+|\s+$)"), "");
      line.erase(at);
    }
    line = std::regex_replace(line, std::regex(R"(\s+$)"), "");
    if (line.empty() && !comment.empty() && !begun_) message_.comments.push_back(comment);
    if (!line.empty()) take(line, comment);
  }

  MessageDefinition finish() {
    if (inside_ || message_.fields.empty()) throw DefinitionError("no complete struct in the file");
    return std::move(message_);
  }

 private:
  void take(const std::string& line, const std::string& comment) {
    static const std::regex kStruct(R"(struct \w+ \{)");
    static const std::regex kConstant(R"(\s*const (\w+) (\w+) = (.+);)");
    begun_ = true;
    std::smatch match;
    if (std::regex_match(line, kStruct)) {
      if (inside_ || !message_.fields.empty()) throw DefinitionError("two structs in one file");
      message_.is_final = before_ == "@final";
      inside_ = true;
    } else if (inside_ && line == "};") {
      inside_ = false;
    } else if (inside_) {
      message_.fields.push_back(field_from_idl(line));
      message_.fields.back().comment = comment;
    } else if (std::regex_match(line, match, kConstant)) {
      message_.constants.push_back({type_from_idl(match[1]), match[2], match[3], comment});
    }
    before_ = line;
  }

  MessageDefinition message_;
  bool begun_ = false;
  bool inside_ = false;
  std::string before_;
};

void add_with_dependencies(const Definitions& definitions, const std::string& name,
                           std::vector<const MessageDefinition*>& out) {
  const auto found = definitions.find(name);
  if (found == definitions.end()) throw DefinitionError("no definition of " + name);
  if (std::ranges::find(out, &found->second) != out.end()) return;
  out.push_back(&found->second);
  for (const FieldDefinition& field : found->second.fields) {
    if (!is_primitive_type(field.type)) add_with_dependencies(definitions, field.type, out);
  }
}

}  // namespace

MessageDefinition parse_idl(std::string_view name, std::string_view text) {
  IdlText parser(name);
  while (!text.empty()) {
    const auto end = text.find('\n');
    parser.take(std::string(text.substr(0, end)));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return parser.finish();
}

Definitions load_idl(const std::filesystem::path& folder) {
  Definitions definitions;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto& path = entry.path();
    if (path.extension() != ".idl") continue;
    const std::string package = path.parent_path().parent_path().filename();
    const std::string name = package + "/" + path.stem().string();
    try {
      definitions[name] = parse_idl(name, read_file(path));
    } catch (const DefinitionError& error) {
      throw DefinitionError(path.string() + ": " + error.what());
    }
  }
  return definitions;
}

std::vector<const MessageDefinition*> with_dependencies(const Definitions& definitions,
                                                        const std::string& name) {
  std::vector<const MessageDefinition*> result;
  add_with_dependencies(definitions, name, result);
  return result;
}

}  // namespace coop::capture
