#pragma once
#include "chassis_driver/chassis.hpp"
#include "chassis_driver/node/odometry_output.hpp"
#include "runtime/node.hpp"

namespace coop::chassis_driver {

struct ChassisDriverConfig;

/// Drives a base: commands and emergency stops in, odometry out.
class DriveBackend {
 public:
  DriveBackend(runtime::Node& node, const ChassisDriverConfig& config,
               const vehicle::AckermannGeometry& geometry);

 private:
  void subscribe();
  void cycle();

  runtime::Node& node_;
  Chassis chassis_;
  OdometryOutput output_;
  vehicle::DriveCause last_cause_ = vehicle::DriveCause::kNoCommand;
};

}  // namespace coop::chassis_driver
