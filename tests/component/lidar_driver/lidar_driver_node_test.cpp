#include "lidar_driver/node/lidar_driver_node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosgraph_msgs/msg/Clock.h>
#include <sensor_msgs/msg/LaserScan.h>

#include <filesystem>
#include <fstream>

#include "conversions/sensors.hpp"
#include "conversions/time.hpp"
#include "core/carmen/carmen_log.hpp"
#include "core/config/error.hpp"
#include "support/component_fixture.hpp"
#include "support/simulated_world.hpp"
#include "support/temporary_folder.hpp"

namespace coop::lidar_driver {
namespace {

using namespace std::chrono_literals;
using runtime::Health;
using runtime::Qos;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// The robot stands at (4, 1) in a room of 8 m x 3 m.
class LidarDriverNodeTest : public testing::Test {
 protected:
  LidarDriverNodeTest() {
    config_.robot = std::string(COOP_SOURCE_DIR) + "/config/robot/egg_collector.urdf";
    config_.sim.lidar.range_noise = 0.0;
    config_.sim.lidar.dropout = 0.0;
    scans_ = fixture_.collect<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream);
    fixture_.add<LidarDriverNode>("lidar_driver", config_);
    simulator_.scene.robot_in_world = {4.0, 1.0, 0.0};
  }
  [[nodiscard]] Health health() { return fixture_.node_of("lidar_driver").health(); }

  LidarDriverConfig config_;
  coop::test::ComponentFixture fixture_;
  coop::test::SimulatedWorld simulator_{fixture_};
  std::shared_ptr<std::vector<sensor_msgs::msg::LaserScan>> scans_;
};

TEST_F(LidarDriverNodeTest, ScansTenTimesASecondOfSimulatedTime) {
  simulator_.publish_world();
  simulator_.publish_truth(1s);
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
  simulator_.publish_world();
  simulator_.publish_truth(1s);
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

TEST_F(LidarDriverNodeTest, IsDegradedWithoutTheSimulator) {
  fixture_.advance(1s);
  EXPECT_EQ(health(), Health::kDegraded);
  EXPECT_TRUE(scans_->empty());
}

/// Twenty scans, one every 0.1 s; the first range counts them.
class LidarLogTest : public testing::Test {
 protected:
  LidarLogTest() {
    std::ofstream out(folder_.path() / "drive.clf");
    for (int i = 0; i < kScans; ++i) {
      carmen::LaserRecord laser;
      laser.stamp = stamp(i);
      laser.range_max = 80.0;
      laser.angle_increment = 0.1;
      laser.ranges = {static_cast<float>(i + 1), 2.0F, 2.0F};
      out << carmen::to_line(laser);
    }
    config_.backend = "log";
    config_.log.file = folder_.path() / "drive.clf";
    config_.log.settle = 0.0;
    options_.run_dir = folder_.path();
    options_.sim_time = true;
    scans_ = fixture_.collect<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream);
    clock_ = fixture_.tester().advertise<rosgraph_msgs::msg::Clock>("clock", Qos::kEvent);
  }
  static Time stamp(int scan) { return time_from_seconds(2000.0 + 0.1 * scan); }
  void start() { fixture_.add<LidarDriverNode>("lidar_driver", config_, options_); }
  void tell(Time time) {
    fixture_.set_time(time);
    clock_.publish(conversions::to_clock_msg(time));
    fixture_.settle();
  }

  static constexpr int kScans = 20;
  coop::test::TemporaryFolder folder_;
  LidarDriverConfig config_;
  runtime::Options options_;
  coop::test::ComponentFixture fixture_;
  std::shared_ptr<std::vector<sensor_msgs::msg::LaserScan>> scans_;
  runtime::Publisher<rosgraph_msgs::msg::Clock> clock_;
};

TEST_F(LidarLogTest, OneThatWasKilledGoesOnWhereItWas) {
  start();
  for (int i = 0; i <= 7; ++i) tell(stamp(i));
  fixture_.remove("lidar_driver", true);
  tell(stamp(12));
  EXPECT_EQ(scans_->size(), 8U);
  start();
  tell(stamp(12));  // the clock stands, and is told again
  EXPECT_EQ(scans_->size(), 13U) << "what was due meanwhile is made up for";
  fixture_.remove("lidar_driver", true);
  start();
  for (int i = 12; i <= kScans; ++i) tell(stamp(i));
  ASSERT_EQ(scans_->size(), static_cast<std::size_t>(kScans));
  for (int i = 0; i < kScans; ++i) {
    EXPECT_EQ((*scans_)[static_cast<std::size_t>(i)].ranges().front(), static_cast<float>(i + 1));
  }
  EXPECT_EQ(fixture_.node_of("lidar_driver").health(), Health::kFinished);
  fixture_.remove("lidar_driver");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "lidar_driver.position"));
}

TEST_F(LidarLogTest, BeginsAtTheBeginningWhereToldTo) {
  start();
  tell(stamp(3));
  fixture_.remove("lidar_driver", true);
  config_.log.resume = false;
  start();
  tell(stamp(3));
  EXPECT_EQ(scans_->size(), 8U);
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
