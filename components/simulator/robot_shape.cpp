#include "simulator/robot_shape.hpp"

#include <cmath>

#include "core/config/error.hpp"

namespace coop::simulator {
namespace {

/// Length of the floor that a tyre presses on, m.
constexpr double kTyreContact = 0.06;
/// Height above the basket's rim within which a released egg still falls into it, m.
constexpr double kReleaseHeight = 0.30;

WheelPatch patch_of(const robot::RobotModel& model, const robot::Joint& wheel) {
  const auto& shapes = model.link(wheel.child).collision;
  if (shapes.empty() || shapes[0].kind != robot::CollisionShape::Kind::kCylinder) {
    throw config::Error("robot: link '" + wheel.child + "' needs a collision cylinder, the wheel");
  }
  WheelPatch patch;
  Pose3 in_base = wheel.origin;
  if (wheel.parent != robot::kBaseLink) {
    for (const robot::Joint& joint : model.joints()) {
      if (joint.child != wheel.parent) continue;
      in_base = joint.origin * wheel.origin;
      patch.steered = joint.is_movable();
    }
  }
  patch.center = in_base.translation().head<2>();
  patch.half_length = 0.5 * kTyreContact;
  patch.half_width = 0.5 * shapes[0].size.z();
  return patch;
}

Eigen::AlignedBox3d basket_of(const robot::RobotModel& model) {
  const auto& shapes = model.link(robot::kBasketLink).collision;
  if (shapes.empty() || shapes[0].kind != robot::CollisionShape::Kind::kBox) {
    throw config::Error("robot: link 'basket_link' needs a collision box");
  }
  const Pose3 box_in_base = model.mount(robot::kBasketLink) * shapes[0].in_link;
  Eigen::AlignedBox3d basket;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                               (corner & 4) != 0 ? 0.5 : -0.5);
    basket.extend(box_in_base * Eigen::Vector3d(sign.cwiseProduct(shapes[0].size)));
  }
  basket.max().z() += kReleaseHeight;
  return basket;
}

}  // namespace

RobotShape shape_of(const robot::RobotModel& model) {
  RobotShape shape;
  shape.footprint = model.footprint();
  shape.base = model.ackermann();
  for (const robot::Joint& joint : model.joints()) {
    if (joint.name.ends_with("_wheel_joint")) shape.wheels.push_back(patch_of(model, joint));
  }
  if (model.has_link(robot::kScraperLink)) {
    shape.scraper = model.scraper();
  } else {
    shape.working_point = model.mount(robot::kWorkingPoint).translation().head<2>();
    shape.basket = basket_of(model);
  }
  if (model.has_link(robot::kImuLink)) shape.imu_in_base = model.mount(robot::kImuLink);
  return shape;
}

}  // namespace coop::simulator
