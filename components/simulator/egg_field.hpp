#pragma once
#include <optional>
#include <vector>

#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/world/state.hpp"
#include "simulator/robot_shape.hpp"

namespace coop::simulator {

/// The gripper as its driver last reported it.
struct GripperInput {
  bool suction = false;
  Eigen::Vector3d tip_in_base{0, 0, 0};  ///< middle of the suction cup's rim, m
};

struct EggConfig {
  double capture_radius = 0.025;  ///< m, horizontally between cup and the egg's top
  double capture_height = 0.030;  ///< m, vertically
  double fall_height = 0.05;      ///< m, an egg that falls farther breaks

  void describe(config::Fields& fields);
};

/// What happens to eggs: wheels crush them, the suction cup takes them up, and lets them go over
/// the basket or elsewhere.
class EggField {
 public:
  EggField(const EggConfig& config, const RobotShape& robot, std::vector<world::Egg> eggs);

  /// State after the robot has come to `robot_in_world` with that steering angle.
  void step(const Pose2& robot_in_world, double steering, const GripperInput& gripper);

  [[nodiscard]] const std::vector<world::Egg>& eggs() const { return eggs_; }

  template <class Archive>
  void persist(Archive& archive) {
    for (world::Egg& egg : eggs_) archive(egg.position, egg.state);
    archive(held_);
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  [[nodiscard]] bool under_a_wheel(const Eigen::Vector2d& egg_in_base, double steering) const;
  [[nodiscard]] std::size_t find_under(const Eigen::Vector3d& tip) const;
  void release(world::Egg& egg, const Eigen::Vector3d& tip_in_base);

  EggConfig config_;
  std::vector<WheelPatch> wheels_;
  Eigen::AlignedBox3d basket_;
  std::vector<world::Egg> eggs_;
  std::size_t held_ = kNone;
};

}  // namespace coop::simulator
