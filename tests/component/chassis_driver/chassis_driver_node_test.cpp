#include "chassis_driver/node/chassis_driver_node.hpp"

#include <coop_msgs/msg/EmergencyStop.h>
#include <geometry_msgs/msg/TwistStamped.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/msg/Odometry.h>
#include <rosgraph_msgs/msg/Clock.h>
#include <sensor_msgs/msg/LaserScan.h>

#include <fstream>
#include <set>

#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "conversions/time.hpp"
#include "core/config/error.hpp"
#include "lidar_driver/node/lidar_driver_node.hpp"
#include "runtime/in_process_transport.hpp"
#include "support/component_fixture.hpp"
#include "support/temporary_folder.hpp"

namespace coop::chassis_driver {
namespace {

using namespace std::chrono_literals;
using runtime::Health;
using runtime::Qos;
using testing::HasSubstr;
using testing::ThrowsMessage;

class LoopbackTest : public testing::Test {
 protected:
  LoopbackTest() {
    config_.robot = std::string(COOP_SOURCE_DIR) + "/config/robot/egg_collector.urdf";
    odoms_ = fixture_.collect<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
    commands_ =
        fixture_.tester().advertise<geometry_msgs::msg::TwistStamped>("cmd_vel", Qos::kCommand);
    stops_ = fixture_.tester().advertise<coop_msgs::msg::EmergencyStop>("emergency_stop",
                                                                        Qos::kStateLatched);
    fixture_.add<ChassisDriverNode>("chassis_driver", config_);
  }

  void drive(const Twist2& command, Duration duration) {
    for (Duration done{0}; done < duration; done += 50ms) {
      commands_.publish(conversions::to_msg(Stamped<Twist2>{fixture_.now(), "base_link", command}));
      fixture_.advance(50ms);
    }
  }
  [[nodiscard]] Odometry last() const {
    return conversions::from_msg(odoms_->back()).value().odometry;
  }

  ChassisDriverConfig config_;
  coop::test::ComponentFixture fixture_;
  std::shared_ptr<std::vector<nav_msgs::msg::Odometry>> odoms_;
  runtime::Publisher<geometry_msgs::msg::TwistStamped> commands_;
  runtime::Publisher<coop_msgs::msg::EmergencyStop> stops_;
};

TEST_F(LoopbackTest, PublishesOdometryAndTransformAtFiftyHertz) {
  (void)fixture_.tester().transforms();
  fixture_.advance(1s);
  EXPECT_EQ(odoms_->size(), 50U);
  EXPECT_TRUE(fixture_.tester().transforms().lookup("odom", "base_link", last().stamp).has_value());
}

TEST_F(LoopbackTest, DrivesAndStopsWithoutCommands) {
  drive({0.4, 0.0}, 3s);
  EXPECT_NEAR(last().base_in_odom.x, 1.2 - 0.16, 0.03);
  EXPECT_NEAR(last().velocity.v, 0.4, 0.026);
  fixture_.advance(700ms);
  EXPECT_EQ(last().velocity.v, 0.0);
}

TEST_F(LoopbackTest, AnEmergencyStopBrakesDespiteCommands) {
  drive({0.4, 0.0}, 2s);
  coop_msgs::msg::EmergencyStop stop;
  stop.source("test");
  stop.engaged(true);
  stops_.publish(stop);
  drive({0.4, 0.0}, 1s);
  EXPECT_EQ(last().velocity.v, 0.0);
}

/// A log of 4 s: odometry every 0.1 s along x at 0.5 m/s, a scan every 0.5 s between two readings.
class LogTest : public testing::Test {
 protected:
  LogTest() {
    std::vector<carmen::Record> records;
    for (int i = 0; i <= 40; ++i) {
      records.emplace_back(
          carmen::OdometryRecord{.stamp = stamp(0.1 * i), .robot_in_odom = {0.05 * i, 0, 0}});
      if (i % 5 != 2) continue;
      carmen::LaserRecord laser;
      laser.stamp = stamp(0.1 * i + 0.05);
      laser.robot_in_odom = {0.05 * i + 0.025, 0, 0};
      laser.ranges.assign(180, static_cast<float>(1 + i));
      laser.angle_min = -1.5707963;
      laser.angle_increment = 0.0174532925;
      laser.range_max = 80.0;
      records.emplace_back(laser);
      ++scans_in_log_;
    }
    std::ofstream out(path_);
    for (const auto& record : records) out << carmen::to_line(record);
    config_.backend = "log";
    config_.log.file = path_.string();
    config_.log.settle = 0.1;
  }

  [[nodiscard]] runtime::Options options() const {
    runtime::Options options;
    options.run_dir = folder_.path();
    return options;
  }
  static Time stamp(double s) { return time_from_seconds(976052890.0 + s); }

  coop::test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "drive.clf";
  ChassisDriverConfig config_;
  coop::test::ComponentFixture fixture_;
  std::size_t scans_in_log_ = 0;
};

TEST_F(LogTest, WaitsForReadersThenPlaysAtItsRateAndFinishes) {
  config_.log.playback.rate = 2.0;
  fixture_.add<ChassisDriverNode>("chassis_driver", config_, options());
  fixture_.advance(3s);
  const auto clocks = fixture_.collect<rosgraph_msgs::msg::Clock>("clock", Qos::kEvent);
  const auto odoms = fixture_.collect<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
  fixture_.advance(1100ms, 5ms);  // 0.1 s to settle, 1 s of playback
  ASSERT_FALSE(clocks->empty());
  EXPECT_EQ(*conversions::from_msg(clocks->at(0)), stamp(-0.1));  // announces the log's time
  EXPECT_EQ(*conversions::from_msg(clocks->at(1)), stamp(0.0));
  EXPECT_NEAR(to_seconds(*conversions::from_msg(clocks->back()) - stamp(0.0)), 2.0, 0.03);
  fixture_.advance(1200ms, 5ms);
  EXPECT_EQ(*conversions::from_msg(clocks->back()), stamp(4.0));
  EXPECT_EQ(odoms->size(), 41 + scans_in_log_);
  EXPECT_EQ(fixture_.node_of("chassis_driver").health(), Health::kFinished);
  EXPECT_EQ(fixture_.node_of("chassis_driver").exit_code(), 0);
}

TEST_F(LogTest, NeverTellsATimeBeforeTheOdometryUpToIt) {
  config_.log.playback.rate = 0.0;
  config_.log.readers = 0;
  Time odometry{};
  Time clock{};
  fixture_.tester().subscribe<nav_msgs::msg::Odometry>(
      "odom", Qos::kSensorStream, [&](const nav_msgs::msg::Odometry& message) {
        odometry = *conversions::from_msg(message.header().stamp());
        EXPECT_GT(odometry, clock);
      });
  fixture_.tester().subscribe<rosgraph_msgs::msg::Clock>(
      "clock", Qos::kEvent,
      [&](const rosgraph_msgs::msg::Clock& message) { clock = *conversions::from_msg(message); });
  fixture_.add<ChassisDriverNode>("chassis_driver", config_, options());
  fixture_.advance(1s, 5ms);
  EXPECT_EQ(odometry, stamp(4.0));
  EXPECT_EQ(clock, stamp(4.0));
}

TEST_F(LogTest, AKilledPlayerGoesOnWhereItWasAndNeverSetsTheClockBack) {
  config_.log.playback.rate = 2.0;
  const auto clocks = fixture_.collect<rosgraph_msgs::msg::Clock>("clock", Qos::kEvent);
  const auto odoms = fixture_.collect<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
  for (const Duration life : {200ms, 700ms, 10ms, 1ms * 5000}) {
    fixture_.add<ChassisDriverNode>("chassis_driver", config_, options());
    fixture_.advance(life, 5ms);
    if (!fixture_.node_of("chassis_driver").wants_to_end()) fixture_.remove("chassis_driver", true);
  }
  EXPECT_EQ(fixture_.node_of("chassis_driver").health(), Health::kFinished);
  for (std::size_t i = 1; i < clocks->size(); ++i) {
    EXPECT_GE(*conversions::from_msg((*clocks)[i]), *conversions::from_msg((*clocks)[i - 1]));
  }
  std::set<Time> stamps;
  for (const auto& odom : *odoms) stamps.insert(*conversions::from_msg(odom.header().stamp()));
  EXPECT_EQ(stamps.size(), 41 + scans_in_log_) << "nothing is left out";
  EXPECT_LE(odoms->size(), stamps.size() + 3) << "and little told twice";
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "chassis_driver.position"));
}

TEST_F(LogTest, StaysAndTellsTheLastTimeWhereAskedTo) {
  config_.log.playback.rate = 20.0;
  config_.log.at_end = "stay";
  const auto odoms = fixture_.collect<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
  fixture_.add<ChassisDriverNode>("chassis_driver", config_, options());
  const auto clocks = fixture_.collect<rosgraph_msgs::msg::Clock>("clock", Qos::kEvent);
  fixture_.advance(1s, 5ms);
  clocks->clear();
  fixture_.remove("chassis_driver", true);
  fixture_.add<ChassisDriverNode>("chassis_driver", config_, options());
  fixture_.advance(1s, 5ms);
  EXPECT_EQ(fixture_.node_of("chassis_driver").health(), Health::kReady);
  EXPECT_EQ(odoms->size(), 41 + scans_in_log_);
  ASSERT_GE(clocks->size(), 5U);
  for (const auto& clock : *clocks) EXPECT_EQ(*conversions::from_msg(clock), stamp(4.0));
}

TEST_F(LogTest, RefusesALogThatIsNotThereOrHoldsNothing) {
  config_.log.file = "";
  EXPECT_THAT([&] { ChassisDriverNode::check(config_); },
              ThrowsMessage<config::Error>(HasSubstr("log.file")));
  config_.log.file = "no/such.clf";
  EXPECT_THAT([&] { ChassisDriverNode::check(config_); },
              ThrowsMessage<std::exception>(HasSubstr("no/such.clf")));
  std::ofstream(path_) << "# empty\n";
  config_.log.file = path_.string();
  EXPECT_THAT([&] { ChassisDriverNode::check(config_); },
              ThrowsMessage<config::Error>(HasSubstr("no odometry")));
}

/// Base and laser play one log, the laser on the clock that the base publishes.
TEST_F(LogTest, TheLidarPlaysTheSameLogInStepAndLosesNoScan) {
  runtime::InProcessTransport bus;
  runtime::ManualClock wall;
  wall.set(time_from_seconds(100.0));
  runtime::ManualClock log_clock;
  runtime::Executor base_executor(wall);
  runtime::Executor laser_executor(log_clock);
  runtime::Options own = options();
  own.name = "chassis_driver";
  runtime::Node base_node(own, bus, wall, base_executor);
  own.name = "lidar_driver";
  own.sim_time = true;
  runtime::Node laser_node(own, bus, log_clock, laser_executor);
  runtime::Node observer(own, bus, wall, base_executor);

  std::vector<LaserScan> scans;
  Time odometry{};
  observer.subscribe<nav_msgs::msg::Odometry>(
      "odom", Qos::kSensorStream, [&](const nav_msgs::msg::Odometry& message) {
        odometry = *conversions::from_msg(message.header().stamp());
      });
  observer.subscribe<sensor_msgs::msg::LaserScan>(
      "scan", Qos::kSensorStream, [&](const sensor_msgs::msg::LaserScan& message) {
        scans.push_back(conversions::from_msg(message).value());
        EXPECT_GE(odometry, scans.back().stamp);
      });
  // What the runtime does under --sim-time.
  laser_node.subscribe<rosgraph_msgs::msg::Clock>("clock", Qos::kEvent,
                                                  [&](const rosgraph_msgs::msg::Clock& message) {
                                                    const bool first = log_clock.now() == Time{};
                                                    log_clock.set(*conversions::from_msg(message));
                                                    if (first) laser_node.handle_clock_jump();
                                                  });

  config_.log.playback.rate = 10.0;
  const ChassisDriverNode base(base_node, config_);
  lidar_driver::LidarDriverConfig laser_config;
  laser_config.backend = "log";
  laser_config.log.file = config_.log.file;
  laser_config.log.mount.x = 0.1;
  laser_config.log.settle = 0.0;
  const lidar_driver::LidarDriverNode laser(laser_node, laser_config);
  for (int i = 0; i < 400; ++i) {
    wall.set(wall.now() + 5ms);
    base_executor.run_once();
    laser_executor.run_once();
  }
  base_executor.run_once();

  ASSERT_EQ(scans.size(), scans_in_log_);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_EQ(scans[i].ranges.front(), static_cast<float>(3 + 5 * i));
    EXPECT_EQ(scans[i].stamp, stamp(0.25 + 0.5 * static_cast<double>(i)));
  }
  EXPECT_TRUE(base_node.wants_to_end());
  EXPECT_TRUE(laser_node.wants_to_end());
  EXPECT_EQ(laser_node.exit_code(), 0);
}

}  // namespace
}  // namespace coop::chassis_driver
