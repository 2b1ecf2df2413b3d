// A part of a robot with nothing to do but to keep its topics going, for tests of what is between
// parts. Its name in the system says which part it plays:
//   lidar_driver  scan and clock-less data at 20 Hz, as a host of sensors has
//   amcl          tells a location for every scan it hears, of the scan's time
//   simulator     hears cmd_vel
#include "conversions/time.hpp"
#include "geometry_msgs/msg/TwistStamped.h"
#include "runtime/run.hpp"
#include "sensor_msgs/msg/LaserScan.h"

namespace {

using coop::runtime::Node;
using coop::runtime::Qos;
using Scan = sensor_msgs::msg::LaserScan;
using Twist = geometry_msgs::msg::TwistStamped;

struct SmallConfig {
  void describe(coop::config::Fields&) {}
};

class SmallPart {
 public:
  using Config = SmallConfig;

  SmallPart(Node& node, const Config&) : node_(node) {
    if (node.name() == "lidar_driver") {
      scans_ = node.advertise<Scan>("scan", Qos::kSensorStream);
      node.every(std::chrono::milliseconds(50), [this] {
        scan_.header(coop::conversions::to_header(node_.now(), "laser_link"));
        scans_.publish(scan_);
      });
      scan_.ranges().assign(360, 1.0F);
    }
    if (node.name() == "amcl") {
      node.advertise_transforms();
      node.subscribe<Scan>("scan", Qos::kSensorStream, [this](const Scan& scan) {
        const auto time = coop::conversions::from_msg(scan.header().stamp());
        if (time) node_.publish_transform("map", "odom", *time, coop::Pose2{});
      });
    }
    if (node.name() == "simulator") {
      node.subscribe<Twist>("cmd_vel", Qos::kCommand,
                            [this](const Twist&) { node_.log().warning("somebody drives"); });
    }
  }

 private:
  Node& node_;
  Scan scan_;
  coop::runtime::Publisher<Scan> scans_;
};

}  // namespace

int main(int argc, char** argv) {
  return coop::runtime::run<SmallPart>(argc, argv, "small_part", "keeps topics going");
}
