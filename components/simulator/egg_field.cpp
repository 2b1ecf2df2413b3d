#include "simulator/egg_field.hpp"

#include <cmath>

#include "core/world/shapes.hpp"

namespace coop::simulator {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using world::EggState;

/// A hanging egg's centre lies below the cup by half its width.
const Vector3d kBelowCup(0.0, 0.0, -world::kEggHalfWidth);

}  // namespace

void EggConfig::describe(config::Fields& fields) {
  fields.number("capture_radius", capture_radius,
                {.unit = "m",
                 .help = "largest horizontal distance of the cup from the egg's top",
                 .min = 0,
                 .max = 0.5});
  fields.number("capture_height", capture_height,
                {.unit = "m",
                 .help = "largest vertical distance of the cup from the egg's top",
                 .min = 0,
                 .max = 0.5});
  fields.number("fall_height", fall_height,
                {.unit = "m", .help = "an egg that falls farther breaks", .min = 0, .max = 10});
}

EggField::EggField(const EggConfig& config, const RobotShape& robot, std::vector<world::Egg> eggs)
    : config_(config), wheels_(robot.wheels), basket_(robot.basket), eggs_(std::move(eggs)) {}

bool EggField::under_a_wheel(const Vector2d& egg_in_base, double steering) const {
  for (const WheelPatch& wheel : wheels_) {
    Vector2d offset = egg_in_base - wheel.center;
    if (wheel.steered) offset = Eigen::Rotation2Dd(-steering) * offset;
    if (std::abs(offset.x()) < wheel.half_length + world::kEggHalfWidth &&
        std::abs(offset.y()) < wheel.half_width + world::kEggHalfWidth) {
      return true;
    }
  }
  return false;
}

std::size_t EggField::find_under(const Vector3d& tip) const {
  std::size_t best = kNone;
  double best_distance = config_.capture_radius;
  for (std::size_t i = 0; i < eggs_.size(); ++i) {
    if (eggs_[i].state != EggState::kOnFloor) continue;
    const Vector3d top = eggs_[i].position - kBelowCup;
    const double distance = (tip - top).head<2>().norm();
    if (distance <= best_distance && std::abs(tip.z() - top.z()) <= config_.capture_height) {
      best = i;
      best_distance = distance;
    }
  }
  return best;
}

void EggField::release(world::Egg& egg, const Vector3d& tip_in_base) {
  if (basket_.contains(tip_in_base)) {
    egg.state = EggState::kCollected;
    return;
  }
  const double fall = egg.position.z() - world::kEggHalfWidth;
  egg.position.z() = world::kEggHalfWidth;
  egg.state = fall > config_.fall_height ? EggState::kBroken : EggState::kOnFloor;
}

void EggField::step(const Pose2& robot_in_world, double steering, const GripperInput& gripper) {
  const Pose3 base = to_pose3(robot_in_world);
  const Vector3d tip = base * gripper.tip_in_base;
  if (gripper.suction && held_ == kNone) {
    held_ = find_under(tip);
    if (held_ != kNone) eggs_[held_].state = EggState::kInGripper;
  }
  if (held_ != kNone) {
    world::Egg& egg = eggs_[held_];
    egg.position = tip + kBelowCup;
    if (!gripper.suction) {
      release(egg, gripper.tip_in_base);
      held_ = kNone;
    }
  }
  const Vector3d in_basket = base * Vector3d(basket_.center().x(), basket_.center().y(),
                                             basket_.min().z() + world::kEggHalfWidth);
  const Pose2 world_in_base = robot_in_world.inverse();
  for (world::Egg& egg : eggs_) {
    if (egg.state == EggState::kCollected) {
      egg.position = in_basket;
    } else if (egg.state == EggState::kOnFloor &&
               under_a_wheel(world_in_base * Vector2d(egg.position.head<2>()), steering)) {
      egg.state = EggState::kBroken;
    }
  }
}

}  // namespace coop::simulator
