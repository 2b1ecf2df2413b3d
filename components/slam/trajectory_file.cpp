#include "slam/trajectory_file.hpp"

#include <array>
#include <cstdio>

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
  carmen::for_each_line(text, name, [&](carmen::FieldCursor& fields) {
    StampedPose2 entry;
    entry.stamp = fields.stamp("the stamp");
    entry.pose = fields.pose("pose");
    trajectory.push_back(entry);
  });
  return trajectory;
}

}  // namespace coop::slam
