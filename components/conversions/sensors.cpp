#include "conversions/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "conversions/covariance.hpp"
#include "conversions/geometry.hpp"
#include "conversions/time.hpp"

namespace coop::conversions {
namespace {

constexpr double kNotMeasured = -1.0;

/// Nothing where the scan's numbers fit together, else what does not.
const char* fault_of(const sensor_msgs::msg::LaserScan& scan) {
  for (const float value :
       {scan.angle_min(), scan.angle_max(), scan.angle_increment(), scan.time_increment(),
        scan.scan_time(), scan.range_min(), scan.range_max()}) {
    if (!std::isfinite(value)) return "an angle, a time or a limit of the scan is not finite";
  }
  if (scan.range_min() < 0.0F || scan.range_min() > scan.range_max()) {
    return "the scan's range_min is negative or above range_max";
  }
  if (scan.ranges().size() > kMaxScanBeams) return "a scan of absurdly many beams";
  if (!scan.intensities().empty() && scan.intensities().size() != scan.ranges().size()) {
    return "the scan has not as many intensities as ranges";
  }
  if (scan.ranges().size() < 2) return nullptr;
  const double increment = scan.angle_increment();
  if (increment == 0.0) return "the scan's angle_increment is zero";
  // Drivers disagree on whether angle_max is the last beam or the one behind it.
  const double last = static_cast<double>(scan.ranges().size() - 1);
  const double told = (static_cast<double>(scan.angle_max()) - scan.angle_min()) / increment;
  if (!(std::abs(told - last) <= 2.0)) return "the scan's angles do not fit its number of ranges";
  return nullptr;
}

Result<Eigen::Matrix3d> measured_covariance(const Covariance3& covariance) {
  if (covariance[0] == kNotMeasured) return fail("the unit does not measure this");
  return from_covariance(covariance);
}

bool is_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

sensor_msgs::msg::LaserScan to_msg(const LaserScan& scan) {
  sensor_msgs::msg::LaserScan message;
  message.header(to_header(scan.stamp, scan.frame_id));
  message.angle_min(scan.angle_min);
  message.angle_max(scan.ranges.empty() ? scan.angle_min : scan.angle(scan.ranges.size() - 1));
  message.angle_increment(scan.angle_increment);
  message.time_increment(scan.time_increment);
  message.scan_time(scan.scan_time);
  message.range_min(scan.range_min);
  message.range_max(scan.range_max);
  message.ranges(scan.ranges);
  return message;
}

Result<LaserScan> from_msg(const sensor_msgs::msg::LaserScan& message) {
  const auto stamp = from_msg(message.header().stamp());
  if (!stamp) return fail(stamp.error());
  if (const char* fault = fault_of(message)) return fail(fault);
  return LaserScan{.stamp = *stamp,
                   .frame_id = message.header().frame_id(),
                   .angle_min = message.angle_min(),
                   .angle_increment = message.angle_increment(),
                   .time_increment = message.time_increment(),
                   .scan_time = message.scan_time(),
                   .range_min = message.range_min(),
                   .range_max = message.range_max(),
                   .ranges = message.ranges()};
}

sensor_msgs::msg::Imu to_msg(const ImuReading& reading) {
  sensor_msgs::msg::Imu message;
  message.header(to_header(reading.stamp, reading.frame_id));
  if (reading.orientation) {
    message.orientation(to_msg(*reading.orientation));
    message.orientation_covariance(to_covariance(reading.orientation_covariance));
  } else {
    message.orientation_covariance()[0] = kNotMeasured;
  }
  message.angular_velocity(to_vector_msg(reading.angular_velocity));
  message.angular_velocity_covariance(to_covariance(reading.angular_velocity_covariance));
  message.linear_acceleration(to_vector_msg(reading.linear_acceleration));
  message.linear_acceleration_covariance(to_covariance(reading.linear_acceleration_covariance));
  return message;
}

Result<ImuReading> from_msg(const sensor_msgs::msg::Imu& message) {
  ImuReading reading;
  const auto stamp = from_msg(message.header().stamp());
  if (!stamp) return fail(stamp.error());
  reading.stamp = *stamp;
  reading.frame_id = message.header().frame_id();
  if (message.orientation_covariance()[0] != kNotMeasured) {
    const auto orientation = from_msg(message.orientation());
    if (!orientation) return fail("orientation: " + orientation.error());
    const auto covariance = from_covariance(message.orientation_covariance());
    if (!covariance) return fail("orientation: " + covariance.error());
    reading.orientation = *orientation;
    reading.orientation_covariance = *covariance;
  }
  const auto velocity = from_msg(message.angular_velocity());
  const auto velocity_covariance = measured_covariance(message.angular_velocity_covariance());
  if (!velocity) return fail("angular velocity: " + velocity.error());
  if (!velocity_covariance) return fail("angular velocity: " + velocity_covariance.error());
  const auto acceleration = from_msg(message.linear_acceleration());
  const auto acceleration_covariance =
      measured_covariance(message.linear_acceleration_covariance());
  if (!acceleration) return fail("acceleration: " + acceleration.error());
  if (!acceleration_covariance) return fail("acceleration: " + acceleration_covariance.error());
  reading.angular_velocity = *velocity;
  reading.angular_velocity_covariance = *velocity_covariance;
  reading.linear_acceleration = *acceleration;
  reading.linear_acceleration_covariance = *acceleration_covariance;
  return reading;
}

sensor_msgs::msg::JointState to_msg(const JointState& state) {
  sensor_msgs::msg::JointState message;
  message.header(to_header(state.stamp, ""));
  message.name(state.names);
  message.position(state.positions);
  message.velocity(state.velocities);
  message.effort(state.efforts);
  return message;
}

Result<JointState> from_msg(const sensor_msgs::msg::JointState& message) {
  const auto stamp = from_msg(message.header().stamp());
  if (!stamp) return fail(stamp.error());
  if (message.name().size() > kMaxJoints) return fail("absurdly many joints");
  const std::set<std::string> names(message.name().begin(), message.name().end());
  if (names.size() != message.name().size()) return fail("a joint named twice");
  if (names.contains("")) return fail("a joint without name");
  for (const auto* values : {&message.position(), &message.velocity(), &message.effort()}) {
    if (!values->empty() && values->size() != message.name().size()) {
      return fail("not as many values as joints");
    }
    if (!is_finite(*values)) return fail("a joint's value is not finite");
  }
  return JointState{*stamp, message.name(), message.position(), message.velocity(),
                    message.effort()};
}

sensor_msgs::msg::CameraInfo to_msg(const Stamped<Intrinsics>& stamped) {
  const Intrinsics& camera = stamped.value;
  sensor_msgs::msg::CameraInfo message;
  message.header(to_header(stamped.stamp, stamped.frame_id));
  message.width(static_cast<std::uint32_t>(camera.width));
  message.height(static_cast<std::uint32_t>(camera.height));
  message.distortion_model("plumb_bob");
  message.d().assign(5, 0.0);
  message.k({camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0});
  message.r({1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  message.p({camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0});
  return message;
}

Result<Stamped<Intrinsics>> from_msg(const sensor_msgs::msg::CameraInfo& message) {
  constexpr std::uint32_t kMaxEdge = 1U << 16;
  const auto stamp = from_msg(message.header().stamp());
  if (!stamp) return fail(stamp.error());
  if (message.width() == 0 || message.height() == 0 || message.width() > kMaxEdge ||
      message.height() > kMaxEdge) {
    return fail("the camera's picture has no pixels, or absurdly many");
  }
  const auto& k = message.k();
  if (!std::ranges::all_of(k, [](double value) { return std::isfinite(value); }) || k[0] <= 0.0 ||
      k[4] <= 0.0) {
    return fail("the camera's focal lengths are not positive, or a number is not finite");
  }
  if (std::ranges::any_of(message.d(), [](double value) { return value != 0.0; })) {
    return fail("the camera distorts");
  }
  return Stamped<Intrinsics>{*stamp,
                             message.header().frame_id(),
                             {static_cast<int>(message.width()), static_cast<int>(message.height()),
                              k[0], k[4], k[2], k[5]}};
}

}  // namespace coop::conversions
