#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"

namespace coop::slam {

/// One line a pose, `stamp x y yaw`: seconds with nine decimals, metres, radians; a comment line
/// says so on top.
[[nodiscard]] std::string to_text(std::span<const StampedPose2> trajectory);

/// The inverse of to_text. Throws std::runtime_error `name:line: ...` for a line that is neither
/// comment nor pose.
[[nodiscard]] std::vector<StampedPose2> parse_trajectory(std::string_view text,
                                                         const std::string& name);

}  // namespace coop::slam
