#include "conversions/covariance.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace coop::conversions {
namespace {

Eigen::Matrix3d diagonal(double a, double b, double c) {
  return Eigen::Vector3d(a, b, c).asDiagonal();
}

TEST(CovarianceConversion, planar_and_spatial_ones_survive_the_round_trip) {
  Eigen::Matrix3d covariance;
  covariance << 4, 1, 0.5, 1, 3, 0.2, 0.5, 0.2, 2;
  EXPECT_EQ(from_planar_covariance(to_planar_covariance(covariance)), covariance);
  EXPECT_EQ(from_position_covariance(to_position_covariance(covariance)), covariance);
  EXPECT_EQ(from_covariance(to_covariance(covariance)), covariance);
}

TEST(CovarianceConversion, zero_is_allowed) {
  EXPECT_TRUE(from_planar_covariance({}));
  EXPECT_TRUE(from_covariance({}));
}

TEST(CovarianceConversion, a_negative_variance_is_refused_also_where_it_is_not_on_the_diagonal) {
  EXPECT_TRUE(from_covariance(to_covariance(diagonal(1, 1, 1))));
  EXPECT_FALSE(from_covariance(to_covariance(diagonal(1, -1e-3, 1))));
  Eigen::Matrix3d covariance = diagonal(1, 1, 1);
  covariance(0, 1) = covariance(1, 0) = 2.0;  // eigenvalues 3 and -1
  EXPECT_FALSE(from_covariance(to_covariance(covariance)));
}

TEST(CovarianceConversion, an_asymmetric_one_is_refused_and_rounding_is_not) {
  Eigen::Matrix3d covariance = diagonal(1, 1, 1);
  covariance(0, 1) = 0.5;
  covariance(1, 0) = 0.5 + 1e-8;
  const auto rounded = from_covariance(to_covariance(covariance));
  ASSERT_TRUE(rounded);
  EXPECT_EQ((*rounded)(0, 1), (*rounded)(1, 0));
  covariance(1, 0) = 0.4;
  EXPECT_FALSE(from_covariance(to_covariance(covariance)));
}

TEST(CovarianceConversion, numbers_that_are_not_finite_are_refused_where_they_are_used) {
  Covariance6 covariance = to_planar_covariance(diagonal(1, 1, 1));
  covariance[14] = std::numeric_limits<double>::quiet_NaN();  // variance of z
  EXPECT_TRUE(from_planar_covariance(covariance));
  EXPECT_FALSE(from_position_covariance(covariance));
  covariance[35] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(from_planar_covariance(covariance));
}

}  // namespace
}  // namespace coop::conversions
