#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "core/time.hpp"

namespace coop {

/// One reading of an inertial measurement unit, in its own frame. Zero covariance means unknown.
struct ImuReading {
  Time stamp{};
  std::string frame_id;
  std::optional<Eigen::Quaterniond>
      orientation{};                             ///< of the frame; units without compass give none
  Eigen::Vector3d angular_velocity{0, 0, 0};     ///< rad/s
  Eigen::Vector3d linear_acceleration{0, 0, 0};  ///< m/s^2, gravity included: +9.81 z at rest
  Eigen::Matrix3d orientation_covariance = Eigen::Matrix3d::Zero();          ///< rad^2
  Eigen::Matrix3d angular_velocity_covariance = Eigen::Matrix3d::Zero();     ///< (rad/s)^2
  Eigen::Matrix3d linear_acceleration_covariance = Eigen::Matrix3d::Zero();  ///< (m/s^2)^2
};

}  // namespace coop
