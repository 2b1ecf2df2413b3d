#pragma once
#include <filesystem>
#include <string>

#include "geometry_msgs/msg/TwistStamped.h"
#include "sensor_msgs/msg/LaserScan.h"
#include "system/support/listener.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {

/// How one joins the test's domain and a robot's partition; without `keys`, in the clear.
inline runtime::DdsOptions guest_options(const std::string& name, const std::string& robot,
                                         const std::filesystem::path& keys) {
  runtime::DdsOptions options{
      .domain = test_domain(), .participant_name = name, .partition = robot};
  options.settings.security = !keys.empty();
  options.settings.keys = keys;
  return options;
}

/// A program that listens in and would drive.
class Guest {
 public:
  Guest(const std::string& name, const std::string& robot, const std::filesystem::path& keys)
      : listener_(guest_options(name, robot, keys)) {}

  void listen_to_scans() {
    listener_.node().subscribe<sensor_msgs::msg::LaserScan>("scan", runtime::Qos::kSensorStream,
                                                            [this](const auto&) { ++scans_; });
  }
  void listen_to_commands() {
    listener_.node().subscribe<geometry_msgs::msg::TwistStamped>(
        "cmd_vel", runtime::Qos::kCommand, [this](const auto&) { ++commands_; });
  }
  void drive() {
    drive_ = listener_.node().advertise<geometry_msgs::msg::TwistStamped>("cmd_vel",
                                                                          runtime::Qos::kCommand);
    drives_ = true;
  }
  void look() {
    if (drives_) drive_.publish(geometry_msgs::msg::TwistStamped());
    listener_.look();
  }
  [[nodiscard]] int scans() const { return scans_; }
  [[nodiscard]] int commands() const { return commands_; }
  /// Who would have heard it drive.
  [[nodiscard]] int driven() const { return drives_ ? drive_.subscribers() : 0; }

 private:
  Listener listener_;
  runtime::Publisher<geometry_msgs::msg::TwistStamped> drive_;
  bool drives_ = false;
  int scans_ = 0;
  int commands_ = 0;
};

}  // namespace coop::test
