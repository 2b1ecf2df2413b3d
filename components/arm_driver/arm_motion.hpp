#pragma once
#include <vector>

#include "arm_driver/inverse_kinematics.hpp"
#include "arm_driver/joint_trajectory.hpp"
#include "core/config/fields.hpp"
#include "core/robot/robot_model.hpp"

namespace coop::arm_driver {

struct ArmMotionConfig {
  double speed = 0.9;         ///< of the joints' velocity limits
  double acceleration = 8.0;  ///< rad/s2, of every joint
  /// rad, one for each joint: folded over the deck, out of the camera's picture and of the laser's
  /// plane. Empty: all joints at zero, or at the limit nearest to it.
  std::vector<double> home{0.0, -0.9, 1.0, 0.0, 1.2, 0.0};
  double contact_height = 0.045;   ///< m above the floor: the cup's rim on an egg that lies
  double approach_height = 0.12;   ///< m above the contact
  double lift_height = 0.16;       ///< m above the contact, before the egg goes sideways
  double basket_clearance = 0.08;  ///< m above the point of release
  double search_radius = 0.030;    ///< m around the place told, where no egg was found at it
  int search_points = 6;           ///< on that circle; 0: no search
  double search_lift = 0.035;      ///< m that the cup is raised between two touches

  void describe(config::Fields& fields);
};

/// Where the arm goes and how: postures and trajectories of a pick, all with the cup pointing down.
/// Frame base_link.
class ArmMotion {
 public:
  /// Throws config::Error where the robot has no arm or no basket, home is no posture of the arm,
  /// or the arm cannot reach the basket.
  ArmMotion(const robot::RobotModel& model, const ArmMotionConfig& config);

  [[nodiscard]] const KinematicChain& chain() const { return ik_.chain(); }
  [[nodiscard]] const MotionLimits& limits() const { return limits_; }
  [[nodiscard]] const ArmMotionConfig& config() const { return config_; }
  [[nodiscard]] const JointVector& home() const { return home_; }
  [[nodiscard]] const JointVector& above_basket() const { return above_basket_; }
  /// The posture of release.
  [[nodiscard]] const JointVector& at_basket() const { return at_basket_; }

  /// Where the cup is to touch, one after the other, to find an egg lying at (x, y): the place
  /// itself, then those of the search circle that the arm can reach.
  [[nodiscard]] Result<std::vector<Eigen::Vector3d>, IkError> touches(
      const Eigen::Vector2d& egg) const;
  /// The cup down at `point`, the posture that is nearest to home.
  [[nodiscard]] Result<JointVector, IkError> posture_at(const Eigen::Vector3d& point) const;

  [[nodiscard]] JointTrajectory to(const JointVector& from, const JointVector& goal) const;
  /// The cup's way is the straight line to `point` where the arm can keep to it, else a motion of
  /// the joints. `point` must be reachable.
  [[nodiscard]] JointTrajectory straight_to(const JointVector& from,
                                            const Eigen::Vector3d& point) const;
  [[nodiscard]] Eigen::Vector3d tip(const JointVector& positions) const;

 private:
  ArmMotionConfig config_;
  InverseKinematics ik_;
  MotionLimits limits_;
  JointVector home_;
  JointVector above_basket_;
  JointVector at_basket_;
};

}  // namespace coop::arm_driver
