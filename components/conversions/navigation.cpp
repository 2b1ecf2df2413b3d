#include "conversions/navigation.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "conversions/covariance.hpp"
#include "conversions/geometry.hpp"
#include "conversions/time.hpp"

namespace coop::conversions {
namespace {

/// The double that is written like the float: 0.05F gives 0.05, where a cast gives 0.0500000007.
double as_written(float value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.begin(), text.end(), value).ptr;
  double result = 0.0;
  std::from_chars(text.begin(), end, result);
  return result;
}

Result<GridGeometry> geometry_from(const nav_msgs::msg::MapMetaData& info) {
  const std::size_t cells = std::size_t{info.width()} * info.height();
  if (cells == 0) return fail("a grid without cells");
  if (cells > kMaxGridCells || std::max(info.width(), info.height()) > kMaxGridCells) {
    return fail("a grid of absurd size");
  }
  if (!(std::isfinite(info.resolution()) && info.resolution() > 0.0F)) {
    return fail("a resolution that is not positive");
  }
  const auto origin = pose2_from_msg(info.origin());
  if (!origin) return fail("origin: " + origin.error());
  if (std::abs(origin->yaw) > 1e-6) return fail("a rotated grid");
  return GridGeometry{static_cast<int>(info.width()), static_cast<int>(info.height()),
                      as_written(info.resolution()), origin->position()};
}

}  // namespace

nav_msgs::msg::Odometry to_msg(const FramedOdometry& framed) {
  nav_msgs::msg::Odometry message;
  message.header(to_header(framed.odometry.stamp, framed.frame_id));
  message.child_frame_id(framed.child_frame_id);
  message.pose().pose(to_msg(framed.odometry.base_in_odom));
  message.pose().covariance(to_planar_covariance(framed.covariance));
  message.twist().twist(to_msg(framed.odometry.velocity));
  return message;
}

Result<FramedOdometry> from_msg(const nav_msgs::msg::Odometry& message) {
  const auto stamp = from_msg(message.header().stamp());
  if (!stamp) return fail(stamp.error());
  const auto pose = pose2_from_msg(message.pose().pose());
  if (!pose) return fail(pose.error());
  const auto covariance = from_planar_covariance(message.pose().covariance());
  if (!covariance) return fail(covariance.error());
  const auto velocity = from_msg(message.twist().twist());
  if (!velocity) return fail(velocity.error());
  return FramedOdometry{{*stamp, *pose, *velocity},
                        *covariance,
                        message.header().frame_id(),
                        message.child_frame_id()};
}

nav_msgs::msg::OccupancyGrid to_msg(const Stamped<OccupancyGrid>& grid) {
  const GridGeometry& geometry = grid.value.geometry;
  nav_msgs::msg::OccupancyGrid message;
  message.header(to_header(grid.stamp, grid.frame_id));
  message.info().map_load_time(message.header().stamp());
  message.info().resolution(static_cast<float>(geometry.resolution));
  message.info().width(static_cast<std::uint32_t>(geometry.width));
  message.info().height(static_cast<std::uint32_t>(geometry.height));
  message.info().origin(to_msg(Pose2{geometry.origin.x(), geometry.origin.y(), 0.0}));
  message.data(grid.value.cells);
  return message;
}

Result<Stamped<OccupancyGrid>> from_msg(const nav_msgs::msg::OccupancyGrid& message) {
  const auto stamp = from_msg(message.header().stamp());
  if (!stamp) return fail(stamp.error());
  const auto geometry = geometry_from(message.info());
  if (!geometry) return fail(geometry.error());
  if (message.data().size() != geometry->size()) {
    return fail("a grid of " + std::to_string(message.info().width()) + " x " +
                std::to_string(message.info().height()) + " with " +
                std::to_string(message.data().size()) + " cells");
  }
  const auto valid = [](std::int8_t value) { return value >= kUnknown && value <= kOccupied; };
  if (!std::all_of(message.data().begin(), message.data().end(), valid)) {
    return fail("a cell is neither unknown nor 0 to 100 percent");
  }
  Stamped<OccupancyGrid> result{*stamp, message.header().frame_id(), {}};
  result.value.geometry = *geometry;
  result.value.cells = message.data();
  return result;
}

nav_msgs::msg::Path to_path_msg(const Stamped<std::vector<Pose2>>& path) {
  nav_msgs::msg::Path message;
  message.header(to_header(path.stamp, path.frame_id));
  message.poses().reserve(path.value.size());
  for (const Pose2& pose : path.value) {
    auto& stamped = message.poses().emplace_back();
    stamped.header(message.header());
    stamped.pose(to_msg(pose));
  }
  return message;
}

Result<Stamped<std::vector<Pose2>>> from_msg(const nav_msgs::msg::Path& message) {
  const auto stamp = from_msg(message.header().stamp());
  if (!stamp) return fail(stamp.error());
  Stamped<std::vector<Pose2>> path{*stamp, message.header().frame_id(), {}};
  path.value.reserve(message.poses().size());
  for (const auto& stamped : message.poses()) {
    const std::string& frame = stamped.header().frame_id();
    if (!frame.empty() && frame != path.frame_id) {
      return fail("a path in " + path.frame_id + " with a pose in " + frame);
    }
    const auto pose = pose2_from_msg(stamped.pose());
    if (!pose) return fail(pose.error());
    path.value.push_back(*pose);
  }
  return path;
}

}  // namespace coop::conversions
