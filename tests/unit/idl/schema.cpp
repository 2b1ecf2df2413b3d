#include "unit/idl/schema.hpp"

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace coop::test {
namespace {

bool is_primitive(const std::string& type) {
  static const std::regex kPrimitive("bool|byte|char|string|u?int(8|16|32|64)|float(32|64)");
  return std::regex_match(type, kPrimitive);
}

std::string type_from_idl(const std::string& type) {
  if (type == "double") return "float64";
  if (type == "float") return "float32";
  if (type == "boolean") return "bool";
  if (is_primitive(type)) return type;
  static const std::regex kScoped(R"((\w+)::msg::(\w+))");
  std::smatch match;
  if (!std::regex_match(type, match, kScoped)) throw std::runtime_error("IDL type " + type);
  return match[1].str() + "/" + match[2].str();
}

Field field_from_idl(const std::string& line) {
  static const std::regex kField(
      R"(\s*(@key )?(?:@default\(value=([^)]*)\) )?(sequence<)?([\w:]+)(>)? (\w+)(\[\d+\])?;)");
  std::smatch match;
  if (!std::regex_match(line, match, kField) || match[3].matched != match[5].matched ||
      (match[3].matched && match[7].matched)) {
    throw std::runtime_error("IDL field: " + line);
  }
  return {.type = type_from_idl(match[4]),
          .array = match[3].matched ? "[]" : match[7].str(),
          .name = match[6],
          .default_value = match[2],
          .key = match[1].matched};
}

}  // namespace

Message parse_msg(const std::string& package, const std::string& text) {
  static const std::regex kIgnored(R"(\s*|\s*[\w/]+\s+\w+\s*=.*)");  // empty, or a constant
  static const std::regex kField(R"(\s*([\w/]+)(\[\d*\])?\s+(\w+)(?:\s+(\S+))?\s*)");
  Message message;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find('#'));
    if (std::regex_match(line, kIgnored)) continue;
    std::smatch match;
    if (!std::regex_match(line, match, kField)) throw std::runtime_error(".msg line: " + line);
    std::string type = match[1];
    if (!is_primitive(type) && type.find('/') == std::string::npos) {
      type = package + "/" + type;
    }
    message.fields.push_back(
        {.type = type, .array = match[2], .name = match[3], .default_value = match[4]});
  }
  return message;
}

Message parse_idl(const std::string& text) {
  static const std::regex kStruct(R"(struct \w+ \{)");
  Message message;
  bool inside = false;
  std::string before;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = std::regex_replace(line.substr(0, line.find("//")), std::regex(R"(\s+$)"), "");
    if (std::regex_match(line, kStruct)) {
      if (inside || !message.fields.empty()) throw std::runtime_error("two structs in one file");
      message.final_struct = before == "@final";
      inside = true;
    } else if (inside && line == "};") {
      inside = false;
    } else if (inside && !line.empty()) {
      message.fields.push_back(field_from_idl(line));
    }
    before = line;
  }
  if (inside || message.fields.empty()) throw std::runtime_error("no complete struct in the file");
  return message;
}

Schema load_idl(const std::filesystem::path& folder) {
  Schema schema;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto& path = entry.path();
    if (path.extension() != ".idl") continue;
    const std::string package = path.parent_path().parent_path().filename();
    schema[package + "/" + path.stem().string()] = parse_idl(read_text(path));
  }
  return schema;
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace coop::test
