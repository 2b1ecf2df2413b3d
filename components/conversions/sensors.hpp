#pragma once
#include <sensor_msgs/msg/CameraInfo.h>
#include <sensor_msgs/msg/Imu.h>
#include <sensor_msgs/msg/JointState.h>
#include <sensor_msgs/msg/LaserScan.h>

#include "core/imu_reading.hpp"
#include "core/intrinsics.hpp"
#include "core/joint_state.hpp"
#include "core/result.hpp"
#include "core/scan.hpp"
#include "core/stamped.hpp"

namespace coop::conversions {

inline constexpr std::size_t kMaxScanBeams = 100'000;
inline constexpr std::size_t kMaxJoints = 1'000;

/// angle_max is that of the last beam; no intensities.
[[nodiscard]] sensor_msgs::msg::LaserScan to_msg(const LaserScan& scan);
/// Ranges may be anything, NaN and infinity included; intensities are dropped. Refused: angles,
/// times or limits that are not finite, range_min negative or above range_max, no increment, more
/// than kMaxScanBeams beams, a number of ranges that is off the angles by more than two beams,
/// intensities that are not as many as ranges.
[[nodiscard]] Result<LaserScan> from_msg(const sensor_msgs::msg::LaserScan& message);

/// Without orientation, the first element of its covariance is -1, as the message's definition
/// says.
[[nodiscard]] sensor_msgs::msg::Imu to_msg(const ImuReading& reading);
/// Refused: angular velocity or acceleration that is not finite or declared not measured, what is
/// no covariance, and, unless declared not measured, an orientation that is none.
[[nodiscard]] Result<ImuReading> from_msg(const sensor_msgs::msg::Imu& message);

[[nodiscard]] sensor_msgs::msg::JointState to_msg(const JointState& state);
/// Refused: lists of unequal length (an empty one is allowed), empty or repeated names, numbers
/// that are not finite.
[[nodiscard]] Result<JointState> from_msg(const sensor_msgs::msg::JointState& message);

/// A camera without distortion.
[[nodiscard]] sensor_msgs::msg::CameraInfo to_msg(const Stamped<Intrinsics>& camera);
/// Of a rectified or undistorted picture. Refused: no pixels, focal lengths that are not positive,
/// numbers that are not finite, a distortion other than zero.
[[nodiscard]] Result<Stamped<Intrinsics>> from_msg(const sensor_msgs::msg::CameraInfo& message);

}  // namespace coop::conversions
