#include "chassis_driver/chassis.hpp"

#include <algorithm>

namespace coop::chassis_driver {
namespace {

/// A cycle that comes later than this (machine asleep) counts as one of this length.
constexpr Duration kLongestCycle = std::chrono::milliseconds(200);

}  // namespace

void ChassisConfig::describe(config::Fields& fields) {
  fields.section("drive", drive);
  fields.section("odometry", odometry);
}

Chassis::Chassis(const ChassisConfig& config, const vehicle::AckermannGeometry& geometry,
                 std::unique_ptr<Base> base)
    : drive_(config.drive, geometry),
      odometry_(config.odometry, geometry),
      base_(std::move(base)) {}

void Chassis::step(Time now) {
  const Duration dt =
      last_ == Time{} ? Duration{0} : std::clamp(now - last_, Duration{0}, kLongestCycle);
  last_ = now;
  odometry_.update(base_->exchange(drive_.step(now, dt), now, dt));
}

}  // namespace coop::chassis_driver
