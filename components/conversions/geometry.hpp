#pragma once
#include <geometry_msgs/msg/Point.h>
#include <geometry_msgs/msg/Pose.h>
#include <geometry_msgs/msg/PoseArray.h>
#include <geometry_msgs/msg/PoseStamped.h>
#include <geometry_msgs/msg/PoseWithCovarianceStamped.h>
#include <geometry_msgs/msg/Quaternion.h>
#include <geometry_msgs/msg/TransformStamped.h>
#include <geometry_msgs/msg/TwistStamped.h>
#include <geometry_msgs/msg/Vector3.h>
#include <tf2_msgs/msg/TFMessage.h>

#include <span>
#include <vector>

#include "core/pose.hpp"
#include "core/pose_estimate.hpp"
#include "core/result.hpp"
#include "core/stamped.hpp"

/// Everywhere here: numbers that are not finite are refused, and so are quaternions whose norm is
/// off 1 by more than 1 % (the zero quaternion of an unset message among them); smaller errors are
/// normalised away.
namespace coop::conversions {

[[nodiscard]] geometry_msgs::msg::Point to_point_msg(const Eigen::Vector3d& point);
[[nodiscard]] Result<Eigen::Vector3d> from_msg(const geometry_msgs::msg::Point& message);

[[nodiscard]] geometry_msgs::msg::Vector3 to_vector_msg(const Eigen::Vector3d& vector);
[[nodiscard]] Result<Eigen::Vector3d> from_msg(const geometry_msgs::msg::Vector3& message);

[[nodiscard]] geometry_msgs::msg::Quaternion to_msg(const Eigen::Quaterniond& rotation);
[[nodiscard]] Result<Eigen::Quaterniond> from_msg(const geometry_msgs::msg::Quaternion& message);

[[nodiscard]] geometry_msgs::msg::Pose to_msg(const Pose2& pose);
[[nodiscard]] geometry_msgs::msg::Pose to_msg(const Pose3& pose);
/// Projection onto the floor: z, roll and pitch are dropped.
[[nodiscard]] Result<Pose2> pose2_from_msg(const geometry_msgs::msg::Pose& message);
[[nodiscard]] Result<Pose3> pose3_from_msg(const geometry_msgs::msg::Pose& message);

[[nodiscard]] geometry_msgs::msg::PoseStamped to_msg(const Stamped<Pose2>& pose);
[[nodiscard]] Result<Stamped<Pose2>> from_msg(const geometry_msgs::msg::PoseStamped& message);

[[nodiscard]] geometry_msgs::msg::PoseArray to_pose_array_msg(
    const Stamped<std::vector<Pose2>>& poses);
[[nodiscard]] Result<Stamped<std::vector<Pose2>>> from_msg(
    const geometry_msgs::msg::PoseArray& message);

[[nodiscard]] geometry_msgs::msg::PoseWithCovarianceStamped to_msg(
    const Stamped<PoseEstimate>& estimate);
/// The covariance of x, y, yaw must be one (covariance.hpp).
[[nodiscard]] Result<Stamped<PoseEstimate>> from_msg(
    const geometry_msgs::msg::PoseWithCovarianceStamped& message);

[[nodiscard]] geometry_msgs::msg::TransformStamped to_msg(const StampedTransform& transform);
/// Refused: an empty frame name, or a frame in itself.
[[nodiscard]] Result<StampedTransform> from_msg(
    const geometry_msgs::msg::TransformStamped& message);

[[nodiscard]] tf2_msgs::msg::TFMessage to_msg(std::span<const StampedTransform> transforms);
/// One bad transform makes the message bad.
[[nodiscard]] Result<std::vector<StampedTransform>> from_msg(
    const tf2_msgs::msg::TFMessage& message);

[[nodiscard]] geometry_msgs::msg::Twist to_msg(const Twist2& twist);
/// Of a base that moves forward and turns; all other components must be finite and are dropped.
[[nodiscard]] Result<Twist2> from_msg(const geometry_msgs::msg::Twist& message);

[[nodiscard]] geometry_msgs::msg::TwistStamped to_msg(const Stamped<Twist2>& twist);
[[nodiscard]] Result<Stamped<Twist2>> from_msg(const geometry_msgs::msg::TwistStamped& message);

}  // namespace coop::conversions
