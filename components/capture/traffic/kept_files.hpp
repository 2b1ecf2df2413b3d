#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

namespace coop::capture {

/// Removes the oldest captures of a folder whose names begin with `prefix` and have `kind` in them,
/// until `count` of them are left. What cannot be removed stays.
void keep_newest(const std::filesystem::path& folder, const std::string& prefix,
                 const std::string& kind, std::size_t count);

}  // namespace coop::capture
