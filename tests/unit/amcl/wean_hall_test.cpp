#include "unit/amcl/wean_hall.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "amcl/amcl.hpp"
#include "support/sanitizer.hpp"

namespace coop::amcl {
namespace {

namespace wean = test::wean_hall;

/// The map is smooth, its walls are half a metre thick, and people walk beside the robot: hence the
/// wide hit_stddev.
AmclConfig with_particles(int most, int scattered) {
  AmclConfig config;
  config.kld.max_particles = most;
  config.scattered_particles = scattered;
  config.field.hit_stddev = 0.2;
  return config;
}

struct Outcome {
  Estimate last;
  double mean_fit = 0.0;  ///< of the scans weighed in
};

Outcome run(Amcl& amcl, const std::vector<wean::Record>& log) {
  Outcome result;
  int updates = 0;
  for (const auto& record : log) {
    const auto estimate = amcl.update(record.scan, record.laser_in_base, record.base_in_odom);
    if (!estimate) continue;
    result.last = *estimate;
    if (!estimate->updated) continue;
    result.mean_fit += estimate->fit;
    ++updates;
  }
  result.mean_fit /= std::max(1, updates);
  return result;
}

/// How many of four seeds, which know nothing at the start, end within half a metre of the
/// reference.
int seeds_that_agree(const Outcome& reference, const OccupancyGrid& map,
                     const std::vector<wean::Record>& log) {
  int agreeing = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    Amcl amcl(with_particles(20000, 100000), map, seed);
    EXPECT_TRUE(amcl.scatter());
    const Estimate last = run(amcl, log).last;
    const double apart = distance(last.robot_in_map.pose, reference.last.robot_in_map.pose);
    agreeing += last.localised && apart < 0.5 ? 1 : 0;
  }
  return agreeing;
}

// No truth was recorded. Corridors that look alike and people at the robot's side keep wrong
// hypotheses alive for long, so the end of the drive is judged, and one seed in four may miss it.

/// The drive begins and ends at the door of the room full of furniture: the best of a million poses
/// tried against the first scan lies there, and so does the later track, carried back by the
/// odometry. A global run of 200,000 particles is no reference here: it may settle on a wrong
/// corridor as well.
TEST(WeanHall, TheFirstDriveEndsWhereManyParticlesTrackedFromItsStartEnd) {
  if (coop::test::kThreadSanitizer) {
    GTEST_SKIP() << "not run: one thread, and minutes under ThreadSanitizer";
  }
  const auto map = wean::map();
  const auto log = wean::log("robotdata1.log.gz");
  if (!map || !log) GTEST_SKIP() << "not run: the Wean Hall recordings are absent";
  AmclConfig many = with_particles(20000, 20000);
  many.kld.min_particles = 20000;
  Amcl amcl(many, *map, 99);
  PoseEstimate start{{39.7, 41.5, -1.65}, Eigen::Matrix3d::Identity() * 0.01};
  amcl.set_pose(start);
  const Outcome reference = run(amcl, *log);
  EXPECT_GT(reference.mean_fit, 0.55);
  const int agreeing = seeds_that_agree(reference, *map, *log);
  RecordProperty("agreeing_of_4", agreeing);
  EXPECT_GE(agreeing, 3);
}

TEST(WeanHall, TheSecondDriveEndsWhereAGlobalRunOfManyParticlesEnds) {
  if (coop::test::kThreadSanitizer) {
    GTEST_SKIP() << "not run: one thread, and minutes under ThreadSanitizer";
  }
  const auto map = wean::map();
  const auto log = wean::log("robotdata2.log.gz");
  if (!map || !log) GTEST_SKIP() << "not run: the Wean Hall recordings are absent";
  Amcl amcl(with_particles(200000, 1000000), *map, 99);
  ASSERT_TRUE(amcl.scatter());
  const Outcome reference = run(amcl, *log);
  EXPECT_TRUE(reference.last.localised);
  const int agreeing = seeds_that_agree(reference, *map, *log);
  RecordProperty("agreeing_of_4", agreeing);
  EXPECT_GE(agreeing, 3);
}

}  // namespace
}  // namespace coop::amcl
