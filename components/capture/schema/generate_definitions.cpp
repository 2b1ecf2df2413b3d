// Writes definitions.cpp: the message definition of every type in the IDL folder, with all it
// depends on. `capture_definitions IDL_FOLDER OUTPUT`
#include <iostream>

#include "capture/schema/idl_parser.hpp"
#include "core/atomic_file.hpp"

namespace coop::capture {
namespace {

std::string generated(const Definitions& definitions) {
  std::string out =
      "// Written by capture_definitions from the IDL folder.\n"
      "#include \"capture/schema/definitions_table.hpp\"\n\n"
      "namespace coop::capture {\n\n"
      "std::span<const KnownDefinition> definitions_table() {\n"
      "  static constexpr KnownDefinition kTable[] = {\n";
  for (const auto& [name, definition] : definitions) {
    out += "      {\"" + long_type_name(name) + "\",\n       R\"ros2msg(" +
           to_ros2msg(with_dependencies(definitions, name)) + ")ros2msg\"},\n";
  }
  return out + "  };\n  return kTable;\n}\n\n}  // namespace coop::capture\n";
}

}  // namespace
}  // namespace coop::capture

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: capture_definitions IDL_FOLDER OUTPUT\n";
    return 2;
  }
  try {
    coop::write_file_atomically(argv[2],
                                coop::capture::generated(coop::capture::load_idl(argv[1])));
  } catch (const std::exception& error) {
    std::cerr << "capture_definitions: " << error.what() << "\n";
    return 1;
  }
}
