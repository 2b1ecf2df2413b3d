#include "amcl/cluster.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/random.hpp"

namespace coop::amcl {
namespace {

TEST(ClusterFinder, TellsTheHeaviestClusterNotTheMeanOverAll) {
  ParticleSet particles;
  for (int i = 0; i < 100; ++i) particles.push_back({1.0, 2.0, 0.5}, 0.006F);  // 60 %
  for (int i = 0; i < 400; ++i)
    particles.push_back({9.0, 2.0, 0.5}, 0.001F);  // 40 %, more particles
  ClusterFinder finder(0.5, 0.2, 1000);
  const Cluster cluster = finder.heaviest(particles);
  EXPECT_EQ(cluster.clusters, 2u);
  EXPECT_EQ(cluster.bins, 2u);
  EXPECT_NEAR(cluster.share, 0.6, 1e-5);
  EXPECT_NEAR(cluster.pose.pose.x, 1.0, 1e-6);
  EXPECT_NEAR(position_stddev(cluster.pose), 0.0, 1e-6);
}

TEST(ClusterFinder, AveragesHeadingsRoundTheTurn) {
  ParticleSet particles;
  particles.push_back({0, 0, std::numbers::pi - 0.05}, 1.0F);
  particles.push_back({0, 0, -std::numbers::pi + 0.15}, 1.0F);
  ClusterFinder finder(0.5, 0.2, 10);
  const Cluster cluster = finder.heaviest(particles);
  EXPECT_NEAR(angle_difference(cluster.pose.pose.yaw, -std::numbers::pi + 0.05), 0.0, 1e-6);
  EXPECT_NEAR(cluster.pose.covariance(2, 2), 0.01, 1e-6);
}

TEST(ClusterFinder, FindsMeanAndCovarianceOfANormalCloud) {
  RandomStream random(2, "test");
  ParticleSet particles;
  for (int i = 0; i < 20000; ++i) {
    const double u = random.normal();
    const double v = random.normal();
    particles.push_back({50.0 + 0.2 * u, -3.0 + 0.1 * u + 0.1 * v, 1.0 + 0.05 * random.normal()},
                        1.0F);
  }
  ClusterFinder finder(0.5, 0.2, 20000);
  const Cluster cluster = finder.heaviest(particles);
  EXPECT_GT(cluster.share, 0.99);
  EXPECT_NEAR(cluster.pose.pose.x, 50.0, 0.005);
  EXPECT_NEAR(cluster.pose.pose.y, -3.0, 0.005);
  EXPECT_NEAR(cluster.pose.covariance(0, 0), 0.04, 0.002);
  EXPECT_NEAR(cluster.pose.covariance(0, 1), 0.02, 0.002);
  EXPECT_NEAR(cluster.pose.covariance(1, 1), 0.02, 0.002);
  EXPECT_NEAR(cluster.pose.covariance(2, 2), 0.0025, 0.0002);
  // Eigenvalues of ((4 2) (2 2)) / 100 are (3 +- sqrt 5) / 100.
  EXPECT_NEAR(position_stddev(cluster.pose), std::sqrt((3.0 + std::sqrt(5.0)) / 100.0), 0.005);
}

}  // namespace
}  // namespace coop::amcl
