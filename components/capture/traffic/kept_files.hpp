#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace coop::capture {

/// What must hold for the captures of a kind, and for the disk.
struct KeptLimits {
  std::size_t count = std::numeric_limits<std::size_t>::max();
  std::uint64_t bytes = std::numeric_limits<std::uint64_t>::max();  ///< of all of them
  std::uint64_t free_bytes = 0;                                     ///< of the disk, at the least
};

/// Removes the oldest captures of a folder whose names begin with `prefix` and have `kind` in them,
/// until the limits hold. What cannot be removed stays. False, and nothing is removed, where the
/// disk would be too full even without all of them.
bool keep_newest(const std::filesystem::path& folder, const std::string& prefix,
                 const std::string& kind, const KeptLimits& limits);

}  // namespace coop::capture
