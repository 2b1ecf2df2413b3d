#include "slam/trajectory_file.hpp"

#include <array>
#include <cstdio>
#include <stdexcept>

#include "core/carmen/carmen_log.hpp"
#include "core/carmen/fields.hpp"

namespace coop::slam {

std::string to_text(std::span<const StampedPose2> trajectory) {
  std::string text = "# stamp[s] x[m] y[m] yaw[rad] of base_link in map\n";
  std::array<char, 128> line{};
  for (const auto& [stamp, pose] : trajectory) {
    const auto nanoseconds = static_cast<long long>(to_nanoseconds(stamp));
    std::snprintf(line.data(), line.size(), "%lld.%09lld %.6f %.6f %.6f\n",
                  nanoseconds / 1'000'000'000, nanoseconds % 1'000'000'000, pose.x, pose.y,
                  pose.yaw);
    text += line.data();
  }
  return text;
}

std::vector<StampedPose2> parse_trajectory(std::string_view text, const std::string& name) {
  std::vector<StampedPose2> trajectory;
  for (int number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line.front() == '#') continue;
    try {
      carmen::FieldCursor fields(line);
      StampedPose2 entry;
      entry.stamp = fields.stamp("the stamp");
      entry.pose = fields.pose("pose");
      trajectory.push_back(entry);
    } catch (const carmen::FormatError& error) {
      throw std::runtime_error(name + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  return trajectory;
}

}  // namespace coop::slam
