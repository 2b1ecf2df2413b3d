#include "lidar_driver/node/lidar_driver_node.hpp"

#include <coop_msgs/msg/GroundTruth.h>
#include <coop_msgs/msg/World.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sensor_msgs/msg/LaserScan.h>

#include "conversions/sensors.hpp"
#include "conversions/time.hpp"
#include "conversions/world.hpp"
#include "core/config/error.hpp"
#include "support/component_fixture.hpp"

namespace coop::lidar_driver {
namespace {

using namespace std::chrono_literals;
using runtime::Health;
using runtime::Qos;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// 8 m x 3 m of free floor; walls of one cell of 0.1 m around it.
world::World room() {
  world::World world;
  world.grid = OccupancyGrid({82, 32, 0.1, {-0.1, -0.1}}, kOccupied);
  for (int y = 1; y < 31; ++y) {
    for (int x = 1; x < 81; ++x) world.grid[{x, y}] = kFree;
  }
  return world;
}

class LidarDriverNodeTest : public testing::Test {
 protected:
  LidarDriverNodeTest() {
    config_.robot = std::string(COOP_SOURCE_DIR) + "/config/robot/egg_collector.urdf";
    config_.sim.lidar.range_noise = 0.0;
    config_.sim.lidar.dropout = 0.0;
    scans_ = fixture_.collect<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream);
    fixture_.add<LidarDriverNode>("lidar_driver", config_);
  }

  void publish_world() {
    world_ = fixture_.tester().advertise<coop_msgs::msg::World>("world", Qos::kStateLatched);
    world_.publish(conversions::to_msg(room(), fixture_.now()));
    fixture_.settle();
  }
  /// Ground truth at 50 Hz with the robot at (4, 1).
  void publish_truth(Duration duration) {
    if (!truth_) {
      truth_.emplace(fixture_.tester().advertise<coop_msgs::msg::GroundTruth>("ground_truth",
                                                                              Qos::kSensorStream));
    }
    for (Duration done{0}; done < duration; done += 20ms) {
      fixture_.advance(20ms);
      world::GroundTruth truth;
      truth.stamp = fixture_.now();
      truth.robot_in_world = {4.0, 1.0, 0.0};
      truth_->publish(conversions::to_msg(truth));
      fixture_.settle();
    }
  }
  [[nodiscard]] Health health() { return fixture_.node_of("lidar_driver").health(); }

  LidarDriverConfig config_;
  coop::test::ComponentFixture fixture_;
  std::shared_ptr<std::vector<sensor_msgs::msg::LaserScan>> scans_;
  runtime::Publisher<coop_msgs::msg::World> world_;
  std::optional<runtime::Publisher<coop_msgs::msg::GroundTruth>> truth_;
};

TEST_F(LidarDriverNodeTest, ScansTenTimesASecondOfSimulatedTime) {
  publish_world();
  publish_truth(1s);
  ASSERT_EQ(scans_->size(), 10U);
  const LaserScan scan = conversions::from_msg(scans_->back()).value();
  EXPECT_EQ(scan.ranges.size(), 360U);
  EXPECT_EQ(scan.frame_id, "laser_link");
  // The laser is mounted 0.62 m ahead of base_link: walls 3.38 m ahead and 1 m to the right.
  EXPECT_NEAR(scan.ranges[180], 3.38F, 1e-4);
  EXPECT_NEAR(scan.ranges[90], 1.0F, 1e-4);
  EXPECT_EQ(health(), Health::kReady);
}

TEST_F(LidarDriverNodeTest, StampsAScanWithTheMomentItSaw) {
  publish_world();
  publish_truth(1s);
  const Time first = *conversions::from_msg(scans_->at(1).header().stamp());
  const Time second = *conversions::from_msg(scans_->at(2).header().stamp());
  EXPECT_EQ(second - first, 100ms);
  EXPECT_EQ(to_nanoseconds(first) % 100'000'000, 0);
}

TEST_F(LidarDriverNodeTest, TellsWhereTheLaserIsMounted) {
  (void)fixture_.tester().transforms();
  fixture_.settle();
  const auto mount =
      fixture_.tester().transforms().lookup("base_link", "laser_link", fixture_.now());
  ASSERT_TRUE(mount.has_value());
  EXPECT_NEAR(mount->translation().x(), 0.62, 1e-12);
}

TEST_F(LidarDriverNodeTest, IsDegradedWithoutWorldOrGroundTruthAndRecovers) {
  fixture_.advance(1s);
  EXPECT_EQ(health(), Health::kDegraded);
  publish_truth(200ms);
  EXPECT_EQ(health(), Health::kDegraded);
  EXPECT_TRUE(scans_->empty());
  publish_world();
  publish_truth(200ms);
  EXPECT_EQ(health(), Health::kReady);
  fixture_.advance(1s);
  EXPECT_EQ(health(), Health::kDegraded);
  publish_truth(200ms);
  EXPECT_EQ(health(), Health::kReady);
}

TEST_F(LidarDriverNodeTest, RefusesALogThatIsNotThere) {
  LidarDriverConfig log;
  log.backend = "log";
  EXPECT_THAT([&] { LidarDriverNode::check(log); },
              ThrowsMessage<config::Error>(HasSubstr("log.file")));
  log.log.file = "no/such.clf";
  EXPECT_THAT([&] { LidarDriverNode::check(log); },
              ThrowsMessage<std::exception>(HasSubstr("no/such.clf")));
}

}  // namespace
}  // namespace coop::lidar_driver
