#pragma once
#include <Eigen/Core>

#include "core/pose.hpp"

namespace coop {

/// Planar pose with its uncertainty.
struct PoseEstimate {
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y, yaw; m^2, m rad, rad^2
};

}  // namespace coop
