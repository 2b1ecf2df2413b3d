#pragma once
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "arm_driver/arm_motion.hpp"

namespace coop::arm_driver::test {

inline constexpr double kHalfTurn = std::numbers::pi;
inline constexpr double kQuarterTurn = std::numbers::pi / 2;

/// The robot as it is shipped.
inline robot::RobotModel collector() {
  return robot::RobotModel::load(std::string(COOP_SOURCE_DIR) + "/config/robot/egg_collector.urdf");
}

inline robot::Joint revolute(const std::string& name, const Eigen::Vector3d& axis,
                             const Eigen::Vector3d& offset, double limit = kHalfTurn) {
  robot::Joint joint;
  joint.name = name;
  joint.type = robot::JointType::kRevolute;
  joint.origin.translation() = offset;
  joint.axis = axis;
  joint.lower = -limit;
  joint.upper = limit;
  joint.max_velocity = 2.0;
  return joint;
}

/// Two links of 1 m in the plane z = 0; the tip's z axis is that of the plane.
inline KinematicChain planar_arm(double limit = kHalfTurn) {
  robot::Joint tip;
  tip.name = "tip";
  tip.origin.translation() = Eigen::Vector3d(1, 0, 0);
  return KinematicChain({revolute("one", Eigen::Vector3d::UnitZ(), {0, 0, 0}, limit),
                         revolute("two", Eigen::Vector3d::UnitZ(), {1, 0, 0}, limit), tip});
}

inline JointVector joints(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace coop::arm_driver::test
