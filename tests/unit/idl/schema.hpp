#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace coop::test {

/// One field of a message, in the words of the .msg language: primitive types bool, int8 .. uint64,
/// float32, float64, string; message types as "package/Type".
struct Field {
  std::string type;
  std::string array;  ///< "" for a single value, "[]" for a sequence, "[N]" for N values
  std::string name;
  std::string default_value;
  bool key = false;

  [[nodiscard]] std::size_t array_size() const { return std::stoul(array.substr(1)); }
  /// The shape on the wire: keys and defaults are not part of it.
  [[nodiscard]] std::string shape() const { return type + array + " " + name; }
};

struct Message {
  std::vector<Field> fields;
  bool final_struct = false;  ///< IDL only
};

using Schema = std::map<std::string, Message>;  ///< by "package/Type"

/// Reads the text of <package>/msg/<Type>.msg. Constants are left out. Throws
/// capture::DefinitionError with the line at fault.
Message parse_msg(const std::string& package, const std::string& text);

/// Reads one IDL file of ours: modules, one struct, and a module of constants. Throws
/// capture::DefinitionError.
Message parse_idl(const std::string& text);

/// Reads all <package>/msg/*.idl below the folder.
Schema load_idl(const std::filesystem::path& folder);

std::string read_text(const std::filesystem::path& file);

}  // namespace coop::test
