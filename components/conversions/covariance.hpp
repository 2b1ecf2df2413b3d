#pragma once
#include <Eigen/Core>
#include <array>

#include "core/result.hpp"

namespace coop::conversions {

/// 6 x 6, row major over x, y, z, roll, pitch, yaw (or linear, then angular velocity).
using Covariance6 = std::array<double, 36>;
using Covariance3 = std::array<double, 9>;

/// Of x, y, yaw; all else is zero.
[[nodiscard]] Covariance6 to_planar_covariance(const Eigen::Matrix3d& covariance);
/// Of x, y, z; all else is zero.
[[nodiscard]] Covariance6 to_position_covariance(const Eigen::Matrix3d& covariance);
[[nodiscard]] Covariance3 to_covariance(const Eigen::Matrix3d& covariance);

/// Refused: what is no covariance, that is, not finite, not symmetric, or with a negative variance
/// along any direction.
[[nodiscard]] Result<Eigen::Matrix3d> from_planar_covariance(const Covariance6& covariance);
[[nodiscard]] Result<Eigen::Matrix3d> from_position_covariance(const Covariance6& covariance);
[[nodiscard]] Result<Eigen::Matrix3d> from_covariance(const Covariance3& covariance);

}  // namespace coop::conversions
