#include "component/slam/slam_node_fixture.hpp"
#include "core/atomic_file.hpp"
#include "slam/trajectory_file.hpp"

namespace coop::slam {
namespace {

/// The best map so far, cells that are occupied.
std::ptrdiff_t walls_of(const nav_msgs::msg::OccupancyGrid& message) {
  const auto map = conversions::from_msg(message);
  return map ? std::ranges::count(map->value.cells, kOccupied) : -1;
}

class SlamNodeAfterADeath : public SlamNodeTest {
 protected:
  SlamNodeAfterADeath() { config_.session_period = 5.0; }

  void map_and_die() {
    start();
    drive(120);
    walls_ = walls_of(maps_->back());
    fixture_.remove("slam", true);  // ends only when the session being written is on disk
    ASSERT_TRUE(std::filesystem::exists(session()));
    maps_->clear();
    transforms_->clear();
  }
  [[nodiscard]] std::filesystem::path session() const { return folder_.path() / "slam.session"; }

  std::ptrdiff_t walls_ = 0;
};

TEST_F(SlamNodeAfterADeath, GoesOnWithTheMapOfTheSession) {
  map_and_die();
  for (int i = 0; i < 10; ++i) drive_.follow_tour();  // half a metre, unobserved
  fixture_.set_time(drive_.stamp);
  start();
  fixture_.advance(1s);
  ASSERT_FALSE(maps_->empty()) << "the map is told at once";
  EXPECT_GT(walls_of(maps_->back()), 0.7 * static_cast<double>(walls_));
  EXPECT_TRUE(map_transforms().empty()) << "where the robot is in it is not known yet";
  drive_.stamp = fixture_.now();
  drive(20);
  EXPECT_EQ(health(), Health::kReady);
  ASSERT_TRUE(error());
  EXPECT_LT(*error(), 0.08);
  fixture_.remove("slam");
  const auto trajectory =
      parse_trajectory(read_file(config_.save_path + "_trajectory.txt"), "trajectory");
  EXPECT_LT(trajectory.front().stamp, time_from_seconds(1001.0)) << "the way before is kept";
}

TEST_F(SlamNodeAfterADeath, GoesOnThoughOdometryWasRestartedAsWell) {
  map_and_die();
  restart_odometry();
  start();
  drive(20);
  ASSERT_TRUE(error());
  EXPECT_LT(*error(), 0.08);
}

TEST_F(SlamNodeAfterADeath, BeginsAnewWhereToldTo) {
  map_and_die();
  config_.resume = false;
  start();
  fixture_.advance(2s);
  EXPECT_TRUE(maps_->empty());
}

TEST_F(SlamNodeAfterADeath, BeginsAnewWhereTheSessionIsCutOrOfAnotherResolution) {
  map_and_die();
  const std::string whole = read_file(session());
  write_file_atomically(session(), std::string_view(whole).substr(0, whole.size() / 2));
  start();
  fixture_.advance(2s);
  EXPECT_TRUE(maps_->empty());
  drive_.stamp = fixture_.now();
  drive(15);
  EXPECT_FALSE(maps_->empty());
  fixture_.remove("slam", true);
  maps_->clear();
  write_file_atomically(session(), whole);
  config_.slam.resolution = 0.1;
  start();
  fixture_.advance(2s);
  EXPECT_TRUE(maps_->empty());
}

TEST_F(SlamNodeAfterADeath, BeginsAnewWhereTheSessionIsOfAnotherTime) {
  map_and_die();
  fixture_.set_time(time_from_seconds(10.0));
  drive_.stamp = fixture_.now();
  start();
  step();
  moved_ = false;
  drive(10);
  ASSERT_FALSE(map_transforms().empty());
  EXPECT_LT(walls_of(maps_->back()), walls_) << "a few scans only";
}

TEST_F(SlamNodeAfterADeath, ARobotThatIsElsewhereBeginsAnewAfterAWhile) {
  map_and_die();
  drive_.base_in_map = {10.5, 7.2, 2.5};
  restart_odometry();
  start();
  const auto stand = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      drive_.wait();
      send_odometry();
      send_scan();
      fixture_.advance(100ms);
    }
  };
  stand(30);
  EXPECT_EQ(health(), Health::kDegraded);
  EXPECT_TRUE(map_transforms().empty());
  stand(90);
  EXPECT_EQ(health(), Health::kReady);
  EXPECT_FALSE(map_transforms().empty());
}

}  // namespace
}  // namespace coop::slam
