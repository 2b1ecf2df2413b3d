#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "core/robot/robot_model.hpp"

namespace coop::arm_driver {

inline constexpr int kMaxJoints = 8;

/// One number for each movable joint of the arm, from base to tip: rad (rad/s, rad/s2), or m for
/// prismatic joints. Lives without heap memory.
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxJoints, 1>;
/// Rows: velocity (3) and angular velocity (3) of the tip, in the chain's base.
using JacobianMatrix = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, kMaxJoints>;

/// A serial arm as the robot's description tells it: joints in order from base to tip.
class KinematicChain {
 public:
  /// `joints` as RobotModel::chain() gives them; `base_in_reference`: where the chain's base lies
  /// in the frame in which poses are wanted. Throws config::Error where there is no movable joint,
  /// more than kMaxJoints, or a movable joint without velocity limit or of another type than
  /// revolute, continuous and prismatic.
  explicit KinematicChain(std::vector<robot::Joint> joints,
                          const Pose3& base_in_reference = Pose3::Identity());

  [[nodiscard]] int size() const { return static_cast<int>(movable_.size()); }
  /// All joints, fixed ones included.
  [[nodiscard]] const std::vector<robot::Joint>& joints() const { return joints_; }
  [[nodiscard]] std::vector<std::string> names() const;  ///< of the movable joints
  /// A continuous joint has the limits -infinity and infinity.
  [[nodiscard]] const JointVector& lower() const { return lower_; }
  [[nodiscard]] const JointVector& upper() const { return upper_; }
  [[nodiscard]] const JointVector& max_velocity() const { return max_velocity_; }
  [[nodiscard]] bool within_limits(const JointVector& positions, double tolerance = 1e-9) const;

  /// Of the tip in the reference frame.
  [[nodiscard]] Pose3 tip_in_reference(const JointVector& positions) const;
  /// The same, with the derivative after the joints.
  Pose3 tip_in_reference(const JointVector& positions, JacobianMatrix& jacobian) const;
  /// Of each movable joint's child in the joint's parent, in order.
  [[nodiscard]] std::vector<Pose3> child_in_parent(const JointVector& positions) const;

 private:
  std::vector<robot::Joint> joints_;
  std::vector<std::size_t> movable_;  ///< indices into joints_
  Pose3 base_in_reference_;
  JointVector lower_;
  JointVector upper_;
  JointVector max_velocity_;
};

}  // namespace coop::arm_driver
