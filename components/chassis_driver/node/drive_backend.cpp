#include "chassis_driver/node/drive_backend.hpp"

#include <coop_msgs/msg/EmergencyStop.h>
#include <geometry_msgs/msg/TwistStamped.h>

#include "chassis_driver/loopback_base.hpp"
#include "chassis_driver/node/chassis_driver_node.hpp"
#include "conversions/geometry.hpp"

namespace coop::chassis_driver {

using runtime::Qos;

DriveBackend::DriveBackend(runtime::Node& node, const ChassisDriverConfig& config,
                           const vehicle::AckermannGeometry& geometry)
    : node_(node),
      chassis_(config.chassis, geometry,
               std::make_unique<LoopbackBase>(geometry, config.chassis.odometry.metres_per_tick)),
      output_(node) {
  subscribe();
  node.every(seconds(1.0 / config.rate), [this] { cycle(); });
}

void DriveBackend::subscribe() {
  node_.subscribe<geometry_msgs::msg::TwistStamped>(
      "cmd_vel", Qos::kCommand, [this](const geometry_msgs::msg::TwistStamped& message) {
        const auto command = conversions::from_msg(message);
        if (command && chassis_.gate().accept(command->value, node_.now())) return;
        if (node_.log().is_due("cmd_vel", seconds(5))) {
          node_.log().warning("refused a velocity command: {}",
                              command ? "not finite" : command.error());
        }
      });
  node_.subscribe<coop_msgs::msg::EmergencyStop>(
      "emergency_stop", Qos::kStateLatched, [this](const coop_msgs::msg::EmergencyStop& message) {
        chassis_.gate().emergency_stops().set(message.source(), message.engaged(),
                                              message.reason());
      });
}

void DriveBackend::cycle() {
  if (node_.now() == Time{}) return;  // simulated time has not begun
  chassis_.step(node_.now());
  output_.publish(chassis_.odometry().odometry(), chassis_.odometry().covariance());
  const vehicle::DriveCause cause = chassis_.setpoint().cause;
  if (cause != last_cause_) node_.log().info("drives by {}", to_string(cause));
  last_cause_ = cause;
}

}  // namespace coop::chassis_driver
