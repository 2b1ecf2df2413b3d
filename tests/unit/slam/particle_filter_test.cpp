#include "slam/particle_filter.hpp"

#include <gtest/gtest.h>

#include "support/simulated_room.hpp"

namespace coop::slam {
namespace {

/// A tour through the barn, mapped on the way.
class Survey {
 public:
  Survey(const SlamConfig& config, std::uint64_t seed, int threads)
      : workers_(threads),
        filter_(config, seed, workers_),
        drive_(test::barn(), {2.0, 1.5, 0.0}, 5),
        start_(drive_.base_in_map) {}

  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      drive_.follow_tour();
      filter_.update(drive_.scan(), drive_.base_in_odom, drive_.laser_in_base);
      if (i == 0) start_ = drive_.base_in_map;  // the first scan's pose is the map's origin
    }
  }
  /// The same over a track of odometry as the shell has it, which the driver restarts at zero
  /// halfway while the robot moves on unseen.
  void run_with_restart(int before, const Pose2& unseen, int after) {
    OdometryTrack track;
    const auto steps = [&](int count, const char* source) {
      for (int i = 0; i < count; ++i) {
        drive_.follow_tour();
        track.insert({drive_.stamp, drive_.base_in_odom}, source);
        const bool first = !filter_.has_map();
        const auto outcome =
            filter_.update(drive_.scan(), *track.at(drive_.stamp), drive_.laser_in_base);
        if (first) start_ = drive_.base_in_map;
        lost_ += outcome.lost ? 1 : 0;
      }
    };
    steps(before, "one");
    drive_.base_in_odom = {};
    drive_.base_in_map = drive_.base_in_map * unseen;
    drive_.stamp += std::chrono::milliseconds(1500);
    steps(after, "two");
    odom_in_track_ = track.odom_in_track();
  }
  /// Scans that were not found in the map.
  [[nodiscard]] int lost() const { return lost_; }
  /// Of the estimated pose, seen from the first, m and rad.
  [[nodiscard]] Pose2 error() const {
    const Pose2 truth = start_.inverse() * drive_.base_in_map;
    return truth.inverse() * (filter_.odom_in_map() * odom_in_track_ * drive_.base_in_odom);
  }
  [[nodiscard]] Pose2 odometry_error(const Pose2& odometry_start) const {
    const Pose2 truth = start_.inverse() * drive_.base_in_map;
    return truth.inverse() * (odometry_start.inverse() * drive_.base_in_odom);
  }
  [[nodiscard]] const ParticleFilter& filter() const { return filter_; }
  [[nodiscard]] ParticleFilter& filter() { return filter_; }
  [[nodiscard]] test::SimulatedDrive& drive() { return drive_; }
  [[nodiscard]] const Pose2& start() const { return start_; }

 private:
  ForkJoin workers_;
  ParticleFilter filter_;
  test::SimulatedDrive drive_;
  Pose2 start_;
  Pose2 odom_in_track_;
  int lost_ = 0;
};

/// Share of the map's walls that are walls of the barn, give or take 8 cm: a cell and a little.
double share_at_walls(const Survey& survey) {
  const OccupancyGrid map = survey.filter().map();
  const OccupancyGrid barn = test::barn();
  double occupied = 0.0;
  double at_walls = 0.0;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (map.cells[i] != kOccupied) continue;
    const Cell cell =
        barn.geometry.cell_of(survey.start() * map.geometry.center_of(map.geometry.cell_at(i)));
    bool near_wall = false;
    for (int dy = -8; dy <= 8; ++dy) {
      for (int dx = -8; dx <= 8; ++dx)
        near_wall = near_wall || barn.at_or({cell.x + dx, cell.y + dy}, kUnknown) == kOccupied;
    }
    occupied += 1.0;
    at_walls += near_wall ? 1.0 : 0.0;
  }
  return at_walls / occupied;
}

SlamConfig small() {
  SlamConfig config;
  config.particles = 6;
  return config;
}

TEST(ParticleFilter, SaysNothingBeforeTheFirstScan) {
  ForkJoin workers(1);
  const ParticleFilter filter(small(), 1, workers);
  EXPECT_FALSE(filter.has_map());
  EXPECT_EQ(filter.odom_in_map(), Pose2{});
  EXPECT_TRUE(filter.trajectory().empty());
  EXPECT_EQ(filter.map().geometry.size(), 0U);
}

TEST(ParticleFilter, FirstScanMakesTheMapsOrigin) {
  Survey survey(small(), 1, 1);
  survey.run(1);
  EXPECT_TRUE(survey.filter().has_map());
  EXPECT_NEAR(survey.error().x, 0.0, 1e-9);
  EXPECT_NEAR(survey.error().yaw, 0.0, 1e-9);
}

TEST(ParticleFilter, ScanWithoutAnyEndIsNotUsed) {
  ForkJoin workers(1);
  ParticleFilter filter(small(), 1, workers);
  LaserScan blind;
  blind.range_max = 10.0F;
  blind.angle_increment = 0.1F;
  blind.ranges.assign(30, std::numeric_limits<float>::infinity());
  EXPECT_FALSE(filter.update(blind, {}, {}).used);
  EXPECT_FALSE(filter.has_map());
}

TEST(ParticleFilter, ScansWithoutMotionAreLeftOutUntilTheIntervalHasPassed) {
  SlamConfig config = small();
  config.max_interval = 5.0;
  Survey survey(config, 1, 1);
  survey.run(1);
  auto& drive = survey.drive();
  int used = 0;
  for (int i = 0; i < 100; ++i) {
    drive.wait(0.1);
    used +=
        survey.filter().update(drive.scan(), drive.base_in_odom, drive.laser_in_base).used ? 1 : 0;
  }
  EXPECT_EQ(used, 2) << "after 5 s and after 10 s";
}

TEST(ParticleFilter, MapsABarnAndKnowsWhereItIs) {
  Survey survey(small(), 1, 2);
  const Pose2 odometry_start = survey.drive().base_in_odom;
  survey.run(1100);  // once round, 55 m
  const Pose2 error = survey.error();
  const Pose2 drift = survey.odometry_error(odometry_start);
  EXPECT_LT(std::hypot(error.x, error.y), 0.05);
  EXPECT_LT(std::abs(error.yaw), 0.01);
  EXPECT_GT(std::hypot(drift.x, drift.y), 0.5)
      << "odometry alone must not be good enough for this test";
}

TEST(ParticleFilter, DrawsWallsWhereTheyAre) {
  Survey survey(small(), 1, 2);
  survey.run(1100);
  const OccupancyGrid map = survey.filter().map();
  EXPECT_GT(std::ranges::count(map.cells, kOccupied), 900);  // 46 m of outer walls are 920 cells
  EXPECT_GT(share_at_walls(survey), 0.98);
}

TEST(ParticleFilter, OdometryThatStartsAgainAtZeroDoesNotSmearTheMap) {
  Survey survey(small(), 1, 2);
  survey.run_with_restart(300, {0.2, 0.05, 0.15}, 300);
  const Pose2 error = survey.error();
  EXPECT_LT(std::hypot(error.x, error.y), 0.06);
  EXPECT_LT(std::abs(error.yaw), 0.02);
  EXPECT_GT(share_at_walls(survey), 0.97);
  EXPECT_EQ(survey.lost(), 0);
}

TEST(ParticleFilter, ARobotCarriedAwayWhileOdometryWasRestartedIsLostAndDrawsNothing) {
  Survey survey(small(), 1, 2);
  survey.run_with_restart(200, {5.0, 4.0, 2.0}, 1);
  EXPECT_EQ(survey.lost(), 1);
  EXPECT_TRUE(survey.filter().lost());
  EXPECT_GT(share_at_walls(survey), 0.97);
}

TEST(ParticleFilter, AnotherFilterGoesOnWithTheMapAndTheWay) {
  Survey first(small(), 1, 2);
  first.run(300);
  const auto nodes = first.filter().trajectory();
  ForkJoin workers(2);
  ParticleFilter second(small(), 7, workers);
  second.resume(first.filter().tiles(), nodes);
  EXPECT_TRUE(second.has_map());
  EXPECT_TRUE(second.lost()) << "until a scan was found in it";
  EXPECT_EQ(second.map(), first.filter().map());
  auto& drive = first.drive();
  for (int i = 0; i < 20; ++i) drive.follow_tour();  // unobserved
  ASSERT_TRUE(second.update(drive.scan(), drive.base_in_odom, drive.laser_in_base).used);
  EXPECT_FALSE(second.lost());
  const Pose2 truth = first.start().inverse() * drive.base_in_map;
  EXPECT_LT(distance(second.odom_in_map() * drive.base_in_odom, truth), 0.06);
  const auto longer = second.trajectory();
  ASSERT_EQ(longer.size(), nodes.size() + 1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_EQ(longer[i].base_in_map, nodes[i].base_in_map);
}

TEST(ParticleFilter, TrajectoryHasANodeForEveryScanUsedAndEndsWhereTheRobotIs) {
  Survey survey(small(), 1, 1);
  survey.run(200);
  const auto nodes = survey.filter().trajectory();
  ASSERT_GT(nodes.size(), 20U);
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    EXPECT_LT(nodes[i - 1].stamp, nodes[i].stamp);
    EXPECT_LT(distance(nodes[i - 1].base_in_map, nodes[i].base_in_map), 0.4)
        << "an ancestor of another line";
  }
  const Pose2 last = survey.filter().odom_in_map() * nodes.back().base_in_odom;
  EXPECT_LT(distance(last, nodes.back().base_in_map), 1e-9);
}

TEST(ParticleFilter, SameSeedGivesTheSameTrajectoryToTheBitWithAnyNumberOfThreads) {
  SlamConfig config = small();
  config.resample_threshold = 0.9;  // resample often: the hard case
  Survey one(config, 42, 1);
  Survey two(config, 42, 2);
  Survey three(config, 42, 3);
  one.run(300);
  two.run(300);
  three.run(300);
  const auto reference = one.filter().trajectory();
  for (const Survey* other : {&two, &three}) {
    const auto nodes = other->filter().trajectory();
    ASSERT_EQ(nodes.size(), reference.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      EXPECT_EQ(nodes[i].base_in_map, reference[i].base_in_map);
    EXPECT_EQ(other->filter().map(), one.filter().map());
  }
}

TEST(ParticleFilter, OtherSeedsGiveOtherTrajectories) {
  Survey one(small(), 1, 1);
  Survey two(small(), 2, 1);
  one.run(50);
  two.run(50);
  EXPECT_NE(one.filter().trajectory().back().base_in_map,
            two.filter().trajectory().back().base_in_map);
}

TEST(ParticleFilter, ResamplesOnlyWhenFewParticlesCount) {
  SlamConfig config = small();
  config.resample_threshold = 0.0;
  Survey never(config, 1, 1);
  never.run(60);
  EXPECT_LT(never.filter().weights().front(), 1.0);
  config.resample_threshold = 1.0;
  Survey always(config, 1, 1);
  always.run(60);
  for (const double weight : always.filter().weights()) EXPECT_DOUBLE_EQ(weight, 1.0 / 6.0);
}

}  // namespace
}  // namespace coop::slam
