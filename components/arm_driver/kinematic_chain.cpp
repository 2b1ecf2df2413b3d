#include "arm_driver/kinematic_chain.hpp"

#include "core/config/error.hpp"

namespace coop::arm_driver {
namespace {

void check(const robot::Joint& joint) {
  const bool known = joint.type == robot::JointType::kRevolute ||
                     joint.type == robot::JointType::kContinuous ||
                     joint.type == robot::JointType::kPrismatic;
  if (!known) {
    throw config::Error("robot: arm joint '" + joint.name +
                        "' must be revolute, continuous or prismatic");
  }
  if (joint.max_velocity <= 0.0) {
    throw config::Error("robot: arm joint '" + joint.name + "' needs a velocity limit");
  }
}

}  // namespace

KinematicChain::KinematicChain(std::vector<robot::Joint> joints, const Pose3& base_in_reference)
    : joints_(std::move(joints)), base_in_reference_(base_in_reference) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!joints_[i].is_movable()) continue;
    check(joints_[i]);
    movable_.push_back(i);
  }
  if (movable_.empty() || movable_.size() > kMaxJoints) {
    throw config::Error("robot: an arm of 1 to " + std::to_string(kMaxJoints) +
                        " movable joints is expected, not of " + std::to_string(movable_.size()));
  }
  lower_.resize(size());
  upper_.resize(size());
  max_velocity_.resize(size());
  for (int i = 0; i < size(); ++i) {
    const robot::Joint& joint = joints_[movable_[static_cast<std::size_t>(i)]];
    lower_[i] = joint.lower;
    upper_[i] = joint.upper;
    max_velocity_[i] = joint.max_velocity;
  }
}

std::vector<std::string> KinematicChain::names() const {
  std::vector<std::string> names;
  for (const std::size_t index : movable_) names.push_back(joints_[index].name);
  return names;
}

bool KinematicChain::within_limits(const JointVector& positions, double tolerance) const {
  return positions.size() == size() && (positions.array() >= lower_.array() - tolerance).all() &&
         (positions.array() <= upper_.array() + tolerance).all();
}

Pose3 KinematicChain::tip_in_reference(const JointVector& positions) const {
  Pose3 pose = base_in_reference_;
  int next = 0;
  for (const robot::Joint& joint : joints_) {
    pose = pose * joint.child_in_parent(joint.is_movable() ? positions[next++] : 0.0);
  }
  return pose;
}

Pose3 KinematicChain::tip_in_reference(const JointVector& positions,
                                       JacobianMatrix& jacobian) const {
  jacobian.resize(6, size());
  Pose3 pose = base_in_reference_;
  int next = 0;
  // First each joint's axis and a point of it, then, the tip being known, what it does there.
  for (const robot::Joint& joint : joints_) {
    pose = pose * joint.child_in_parent(joint.is_movable() ? positions[next] : 0.0);
    if (!joint.is_movable()) continue;
    jacobian.col(next).head<3>() = pose.translation();
    jacobian.col(next).tail<3>() = pose.linear() * joint.axis;
    ++next;
  }
  for (int i = 0; i < size(); ++i) {
    const Eigen::Vector3d point = jacobian.col(i).head<3>();
    const Eigen::Vector3d axis = jacobian.col(i).tail<3>();
    if (joints_[movable_[static_cast<std::size_t>(i)]].type == robot::JointType::kPrismatic) {
      jacobian.col(i) << axis, Eigen::Vector3d::Zero();
    } else {
      jacobian.col(i).head<3>() = axis.cross(pose.translation() - point);
    }
  }
  return pose;
}

std::vector<Pose3> KinematicChain::child_in_parent(const JointVector& positions) const {
  std::vector<Pose3> poses;
  poses.reserve(movable_.size());
  int next = 0;
  for (const std::size_t index : movable_) {
    poses.push_back(joints_[index].child_in_parent(positions[next++]));
  }
  return poses;
}

}  // namespace coop::arm_driver
