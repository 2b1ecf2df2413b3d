#include "conversions/geometry.hpp"

#include <cmath>

#include "conversions/covariance.hpp"
#include "conversions/time.hpp"

namespace coop::conversions {
namespace {

constexpr double kNormTolerance = 0.01;

template <class Message>
Result<Eigen::Vector3d> vector_from(const Message& message) {
  const Eigen::Vector3d vector(message.x(), message.y(), message.z());
  if (!vector.allFinite()) return fail("a coordinate is not finite");
  return vector;
}

template <class Message>
Message vector_to(const Eigen::Vector3d& vector) {
  Message message;
  message.x(vector.x());
  message.y(vector.y());
  message.z(vector.z());
  return message;
}

/// The header of a message put around its value.
template <class T>
Result<Stamped<T>> with_header(const std_msgs::msg::Header& header, Result<T> value) {
  if (!value) return fail(std::move(value.error()));
  const auto stamp = from_msg(header.stamp());
  if (!stamp) return fail(stamp.error());
  return Stamped<T>{*stamp, header.frame_id(), std::move(*value)};
}

}  // namespace

geometry_msgs::msg::Point to_point_msg(const Eigen::Vector3d& point) {
  return vector_to<geometry_msgs::msg::Point>(point);
}

Result<Eigen::Vector3d> from_msg(const geometry_msgs::msg::Point& message) {
  return vector_from(message);
}

geometry_msgs::msg::Vector3 to_vector_msg(const Eigen::Vector3d& vector) {
  return vector_to<geometry_msgs::msg::Vector3>(vector);
}

Result<Eigen::Vector3d> from_msg(const geometry_msgs::msg::Vector3& message) {
  return vector_from(message);
}

geometry_msgs::msg::Quaternion to_msg(const Eigen::Quaterniond& rotation) {
  geometry_msgs::msg::Quaternion message;
  message.x(rotation.x());
  message.y(rotation.y());
  message.z(rotation.z());
  message.w(rotation.w());
  return message;
}

Result<Eigen::Quaterniond> from_msg(const geometry_msgs::msg::Quaternion& message) {
  const Eigen::Quaterniond rotation(message.w(), message.x(), message.y(), message.z());
  // Written so that NaN fails too.
  if (!(std::abs(rotation.norm() - 1.0) <= kNormTolerance)) {
    return fail("a quaternion is not of unit length");
  }
  return rotation.normalized();
}

geometry_msgs::msg::Pose to_msg(const Pose2& pose) {
  geometry_msgs::msg::Pose message;
  message.position(to_point_msg({pose.x, pose.y, 0.0}));
  message.orientation().z(std::sin(0.5 * pose.yaw));
  message.orientation().w(std::cos(0.5 * pose.yaw));
  return message;
}

geometry_msgs::msg::Pose to_msg(const Pose3& pose) {
  geometry_msgs::msg::Pose message;
  message.position(to_point_msg(pose.translation()));
  message.orientation(to_msg(Eigen::Quaterniond(pose.linear())));
  return message;
}

Result<Pose2> pose2_from_msg(const geometry_msgs::msg::Pose& message) {
  return pose3_from_msg(message).map([](const Pose3& pose) { return to_pose2(pose); });
}

Result<Pose3> pose3_from_msg(const geometry_msgs::msg::Pose& message) {
  const auto position = from_msg(message.position());
  if (!position) return fail(position.error());
  const auto rotation = from_msg(message.orientation());
  if (!rotation) return fail(rotation.error());
  Pose3 pose = Pose3::Identity();
  pose.translation() = *position;
  pose.linear() = rotation->toRotationMatrix();
  return pose;
}

geometry_msgs::msg::PoseStamped to_msg(const Stamped<Pose2>& pose) {
  geometry_msgs::msg::PoseStamped message;
  message.header(to_header(pose.stamp, pose.frame_id));
  message.pose(to_msg(pose.value));
  return message;
}

Result<Stamped<Pose2>> from_msg(const geometry_msgs::msg::PoseStamped& message) {
  return with_header(message.header(), pose2_from_msg(message.pose()));
}

geometry_msgs::msg::PoseArray to_pose_array_msg(const Stamped<std::vector<Pose2>>& poses) {
  geometry_msgs::msg::PoseArray message;
  message.header(to_header(poses.stamp, poses.frame_id));
  message.poses().reserve(poses.value.size());
  for (const Pose2& pose : poses.value) message.poses().push_back(to_msg(pose));
  return message;
}

Result<Stamped<std::vector<Pose2>>> from_msg(const geometry_msgs::msg::PoseArray& message) {
  std::vector<Pose2> poses;
  poses.reserve(message.poses().size());
  for (const auto& pose : message.poses()) {
    const auto converted = pose2_from_msg(pose);
    if (!converted) return fail(converted.error());
    poses.push_back(*converted);
  }
  return with_header(message.header(), Result<std::vector<Pose2>>(std::move(poses)));
}

geometry_msgs::msg::PoseWithCovarianceStamped to_msg(const Stamped<PoseEstimate>& estimate) {
  geometry_msgs::msg::PoseWithCovarianceStamped message;
  message.header(to_header(estimate.stamp, estimate.frame_id));
  message.pose().pose(to_msg(estimate.value.pose));
  message.pose().covariance(to_planar_covariance(estimate.value.covariance));
  return message;
}

Result<Stamped<PoseEstimate>> from_msg(
    const geometry_msgs::msg::PoseWithCovarianceStamped& message) {
  const auto pose = pose2_from_msg(message.pose().pose());
  if (!pose) return fail(pose.error());
  const auto covariance = from_planar_covariance(message.pose().covariance());
  if (!covariance) return fail(covariance.error());
  return with_header(message.header(), Result<PoseEstimate>({*pose, *covariance}));
}

geometry_msgs::msg::TransformStamped to_msg(const StampedTransform& transform) {
  geometry_msgs::msg::TransformStamped message;
  message.header(to_header(transform.stamp, transform.parent));
  message.child_frame_id(transform.child);
  message.transform().translation(to_vector_msg(transform.child_in_parent.translation()));
  message.transform().rotation(to_msg(Eigen::Quaterniond(transform.child_in_parent.linear())));
  return message;
}

Result<StampedTransform> from_msg(const geometry_msgs::msg::TransformStamped& message) {
  const std::string& parent = message.header().frame_id();
  const std::string& child = message.child_frame_id();
  if (parent.empty() || child.empty()) return fail("a transform without frame name");
  if (parent == child) return fail("a transform of a frame in itself: " + child);
  const auto stamp = from_msg(message.header().stamp());
  if (!stamp) return fail(stamp.error());
  const auto translation = from_msg(message.transform().translation());
  if (!translation) return fail(child + ": " + translation.error());
  const auto rotation = from_msg(message.transform().rotation());
  if (!rotation) return fail(child + ": " + rotation.error());
  StampedTransform result{*stamp, parent, child, Pose3::Identity()};
  result.child_in_parent.translation() = *translation;
  result.child_in_parent.linear() = rotation->toRotationMatrix();
  return result;
}

tf2_msgs::msg::TFMessage to_msg(std::span<const StampedTransform> transforms) {
  tf2_msgs::msg::TFMessage message;
  message.transforms().reserve(transforms.size());
  for (const auto& transform : transforms) message.transforms().push_back(to_msg(transform));
  return message;
}

Result<std::vector<StampedTransform>> from_msg(const tf2_msgs::msg::TFMessage& message) {
  std::vector<StampedTransform> transforms;
  transforms.reserve(message.transforms().size());
  for (const auto& transform : message.transforms()) {
    auto converted = from_msg(transform);
    if (!converted) return fail(std::move(converted.error()));
    transforms.push_back(std::move(*converted));
  }
  return transforms;
}

geometry_msgs::msg::Twist to_msg(const Twist2& twist) {
  geometry_msgs::msg::Twist message;
  message.linear().x(twist.v);
  message.angular().z(twist.omega);
  return message;
}

Result<Twist2> from_msg(const geometry_msgs::msg::Twist& message) {
  const auto linear = from_msg(message.linear());
  if (!linear) return fail(linear.error());
  const auto angular = from_msg(message.angular());
  if (!angular) return fail(angular.error());
  return Twist2{linear->x(), angular->z()};
}

geometry_msgs::msg::TwistStamped to_msg(const Stamped<Twist2>& twist) {
  geometry_msgs::msg::TwistStamped message;
  message.header(to_header(twist.stamp, twist.frame_id));
  message.twist(to_msg(twist.value));
  return message;
}

Result<Stamped<Twist2>> from_msg(const geometry_msgs::msg::TwistStamped& message) {
  return with_header(message.header(), from_msg(message.twist()));
}

}  // namespace coop::conversions
