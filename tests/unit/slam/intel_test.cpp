// The Intel Research Lab, as recorded: the whole way from the log to the published measure.
#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "core/carmen/carmen_log.hpp"
#include "experiments/slam/relations.hpp"
#include "slam/particle_filter.hpp"
#include "support/shared_data.hpp"

namespace coop::slam {
namespace {

TEST(IntelLab, IsMappedWithinEightCentimetres) {
  const auto log = test::shared_data("slam/intel.clf");
  const auto relations_file = test::shared_data("slam/intel.relations");
  if (!log || !relations_file) GTEST_SKIP() << "not run: the shared data set is absent";
  auto records = carmen::read_log(*log);
  carmen::sort_by_stamp(records);
  SlamConfig config;
  config.particles = 8;  // fewer than usual, for the sanitizers' sake; also reaches the measure
  ForkJoin workers(2);
  ParticleFilter filter(config, 1, workers);
  std::vector<StampedPose2> odometry;
  for (const auto& record : records) {
    if (const auto* reading = std::get_if<carmen::OdometryRecord>(&record)) {
      odometry.push_back({reading->stamp, reading->robot_in_odom});
    } else if (const auto* laser = std::get_if<carmen::LaserRecord>(&record)) {
      filter.update(carmen::to_scan(*laser, "laser_link"), laser->robot_in_odom, {});
    }
  }
  const auto trajectory = interpolate_trajectory(filter.trajectory(), odometry);
  const auto relations =
      experiments::parse_relations(read_file(*relations_file), relations_file->string());
  const auto error = experiments::relations_error(relations, trajectory);
  EXPECT_EQ(error.relations, 2984U);
  // 0.066 measured; 0.070 is published for this method. A loop that does not close gives 0.2 and
  // more.
  EXPECT_LT(error.mean_translation, 0.08);
  const auto map = filter.map();
  EXPECT_NEAR(map.geometry.width * map.geometry.resolution, 40.0, 15.0)
      << "the building is 28 m x 28 m, seen through windows beyond";
}

}  // namespace
}  // namespace coop::slam
