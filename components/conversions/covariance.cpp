#include "conversions/covariance.hpp"

#include <Eigen/Eigenvalues>

namespace coop::conversions {
namespace {

constexpr std::array<int, 3> kPlanar{0, 1, 5};
constexpr std::array<int, 3> kPosition{0, 1, 2};

Covariance6 spread(const Eigen::Matrix3d& covariance, const std::array<int, 3>& rows) {
  Covariance6 result{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int at = 6 * rows[static_cast<std::size_t>(i)] + rows[static_cast<std::size_t>(j)];
      result[static_cast<std::size_t>(at)] = covariance(i, j);
    }
  }
  return result;
}

Result<Eigen::Matrix3d> checked(const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite()) return fail("covariance is not finite");
  // Sums of squares computed in another order or in single precision differ by about this much.
  const double tolerance = 1e-6 * covariance.cwiseAbs().maxCoeff();
  if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > tolerance) {
    return fail("covariance is not symmetric");
  }
  const Eigen::Matrix3d symmetric = 0.5 * (covariance + covariance.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric, Eigen::EigenvaluesOnly);
  if (solver.eigenvalues().minCoeff() < -tolerance)
    return fail("covariance has a negative variance");
  return symmetric;
}

Result<Eigen::Matrix3d> gather(const Covariance6& covariance, const std::array<int, 3>& rows) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int at = 6 * rows[static_cast<std::size_t>(i)] + rows[static_cast<std::size_t>(j)];
      result(i, j) = covariance[static_cast<std::size_t>(at)];
    }
  }
  return checked(result);
}

}  // namespace

Covariance6 to_planar_covariance(const Eigen::Matrix3d& covariance) {
  return spread(covariance, kPlanar);
}

Covariance6 to_position_covariance(const Eigen::Matrix3d& covariance) {
  return spread(covariance, kPosition);
}

Covariance3 to_covariance(const Eigen::Matrix3d& covariance) {
  Covariance3 result{};
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(result.data()) = covariance;
  return result;
}

Result<Eigen::Matrix3d> from_planar_covariance(const Covariance6& covariance) {
  return gather(covariance, kPlanar);
}

Result<Eigen::Matrix3d> from_position_covariance(const Covariance6& covariance) {
  return gather(covariance, kPosition);
}

Result<Eigen::Matrix3d> from_covariance(const Covariance3& covariance) {
  return checked(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(covariance.data()));
}

}  // namespace coop::conversions
