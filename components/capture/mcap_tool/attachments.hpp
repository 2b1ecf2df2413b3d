#pragma once
#include "capture/mcap/reader.hpp"

namespace coop::mcap {

/// A name within one folder made of an attachment's: path separators, control characters and what
/// begins with a dot are replaced, so that no name in a file is a path. Never empty.
[[nodiscard]] std::string safe_file_name(const std::string& name);

/// Writes the attachments with one of the names (all of them where there are none) into the folder,
/// which is created. A name that is there gets a number; nothing is overwritten. Returns the files.
/// Throws FileError (damaged), std::system_error, std::invalid_argument for a name that no
/// attachment has.
std::vector<std::filesystem::path> extract_attachments(const Reader& reader,
                                                       const std::vector<std::string>& names,
                                                       const std::filesystem::path& folder);

}  // namespace coop::mcap
