#pragma once
#include <gtest/gtest.h>
#include <nav_msgs/msg/Odometry.h>
#include <sensor_msgs/msg/LaserScan.h>
#include <tf2_msgs/msg/TFMessage.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "slam/node/slam_node.hpp"
#include "support/component_fixture.hpp"
#include "support/simulated_room.hpp"
#include "support/temporary_folder.hpp"

namespace coop::slam {

using namespace std::chrono_literals;
using runtime::Health;
using runtime::Qos;

/// slam in a world of its own: a drive through the barn, whose odometry and scans the test sends.
class SlamNodeTest : public testing::Test {
 protected:
  SlamNodeTest() : drive_(test::barn(), {2.0, 1.5, 0.0}, 5), start_(drive_.base_in_map) {
    config_.slam.particles = 3;
    config_.save_path = (folder_.path() / "barn").string();
    maps_ = fixture_.collect<nav_msgs::msg::OccupancyGrid>("map", Qos::kStateLatched);
    transforms_ = fixture_.collect<tf2_msgs::msg::TFMessage>("tf", Qos::kEvent);
    results_ = fixture_.collect<coop_msgs::msg::SaveMapResult>("save_map_result", Qos::kEvent);
    odometry_ = fixture_.tester().advertise<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
    scan_ = fixture_.tester().advertise<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream);
    save_ = fixture_.tester().advertise<coop_msgs::msg::SaveMap>("save_map", Qos::kEvent);
  }

  void start(bool reliable = false) {
    runtime::Options options;
    options.reliable_streams = reliable;
    options.run_dir = folder_.path();
    fixture_.add<SlamNode>("slam", config_, options);
    mount_laser();
  }
  void mount_laser() {
    fixture_.tester().publish_static_transform("base_link", "laser_link",
                                               to_pose3(drive_.laser_in_base));
    fixture_.settle();
  }
  void send_odometry() {
    conversions::FramedOdometry odometry;
    odometry.odometry.stamp = drive_.stamp;
    odometry.odometry.base_in_odom = drive_.base_in_odom;
    odometry_.publish(conversions::to_msg(odometry));
    ++readings_;
  }
  /// A driver that begins again at zero.
  void restart_odometry() {
    drive_.base_in_odom = {};
    odometry_ = fixture_.tester().advertise<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
  }
  void send_scan() { scan_.publish(conversions::to_msg(drive_.scan())); }
  /// A tenth of a second of the tour.
  void step(bool with_odometry = true) {
    drive_.follow_tour();
    if (!moved_) start_ = drive_.base_in_map;
    moved_ = true;
    if (with_odometry) send_odometry();
    send_scan();
    fixture_.advance(100ms);
  }
  void drive(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }
  void request_save(const std::string& path) {
    coop_msgs::msg::SaveMap request;
    request.request_id("r1");
    request.path(path);
    save_.publish(request);
    fixture_.settle();
  }
  [[nodiscard]] std::vector<geometry_msgs::msg::TransformStamped> map_transforms() const {
    std::vector<geometry_msgs::msg::TransformStamped> found;
    for (const auto& message : *transforms_) {
      for (const auto& transform : message.transforms()) {
        if (transform.header().frame_id() == "map" && transform.child_frame_id() == "odom")
          found.push_back(transform);
      }
    }
    return found;
  }
  /// Of the pose that is told, seen from the first map's origin; nothing where none is told.
  [[nodiscard]] std::optional<double> error() const {
    const auto transforms = map_transforms();
    if (transforms.empty()) return std::nullopt;
    const auto& t = transforms.back().transform();
    const Pose2 odom_in_map{t.translation().x(), t.translation().y(),
                            2.0 * std::atan2(t.rotation().z(), t.rotation().w())};
    return distance(odom_in_map * drive_.base_in_odom, start_.inverse() * drive_.base_in_map);
  }
  [[nodiscard]] Health health() { return fixture_.node_of("slam").health(); }

  test::TemporaryFolder folder_;
  test::ComponentFixture fixture_;
  test::SimulatedDrive drive_;
  Pose2 start_;
  bool moved_ = false;
  std::size_t readings_ = 0;
  SlamNodeConfig config_;
  std::shared_ptr<std::vector<nav_msgs::msg::OccupancyGrid>> maps_;
  std::shared_ptr<std::vector<tf2_msgs::msg::TFMessage>> transforms_;
  std::shared_ptr<std::vector<coop_msgs::msg::SaveMapResult>> results_;
  runtime::Publisher<nav_msgs::msg::Odometry> odometry_;
  runtime::Publisher<sensor_msgs::msg::LaserScan> scan_;
  runtime::Publisher<coop_msgs::msg::SaveMap> save_;
};

}  // namespace coop::slam
