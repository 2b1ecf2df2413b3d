#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "capture/schema/message_definition.hpp"

namespace coop::capture {

/// Reads one IDL file of ours: modules, one struct, and before it a module of constants. Comments
/// behind fields and constants, and those at the top of the file, are kept. `name` is
/// "package/Type". Throws DefinitionError.
[[nodiscard]] MessageDefinition parse_idl(std::string_view name, std::string_view text);

using Definitions = std::map<std::string, MessageDefinition>;  ///< by "package/Type"

/// Reads all <package>/msg/*.idl below the folder. Throws DefinitionError naming the file.
[[nodiscard]] Definitions load_idl(const std::filesystem::path& folder);

/// The definition of this name and of all it is made of, itself first, the others in the order in
/// which they are met. Throws DefinitionError for a type that is not among them.
[[nodiscard]] std::vector<const MessageDefinition*> with_dependencies(
    const Definitions& definitions, const std::string& name);

}  // namespace coop::capture
