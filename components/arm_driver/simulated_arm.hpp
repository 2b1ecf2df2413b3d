#pragma once
#include <filesystem>
#include <optional>

#include "arm_driver/arm_device.hpp"

namespace coop::arm_driver {

/// The simulated arm: every joint's servo follows its target at no more than the joint's velocity
/// limit and stops at the joint's limits; the cup is closed while the simulator says that an egg
/// hangs on it.
class SimulatedArm : public ArmDevice {
 public:
  /// Truth older than this says nothing of the present, s.
  static constexpr double kTruthLifetime = 0.5;

  /// A real arm's controller keeps posture and pump while the driver is away. `memory` (may be
  /// empty: none) is the file in which the simulated one does; without it the arm starts at `start`
  /// with the pump off.
  SimulatedArm(const KinematicChain& chain, const JointVector& start,
               const std::filesystem::path& memory = {});
  ~SimulatedArm() override;

  /// What the simulator's ground truth says, heard at `now`.
  void hear_truth(bool egg_in_gripper, Time now);

  [[nodiscard]] ArmReading read(Time now) override;
  void command(const JointVector& target, bool suction, Time now) override;

 private:
  struct Memory;
  [[nodiscard]] Memory memory() const;
  void remember() const;
  [[nodiscard]] bool recall();

  KinematicChain chain_;
  int file_ = -1;
  JointVector positions_;
  JointVector velocities_;
  bool suction_ = false;
  std::optional<Time> moved_;  ///< time of the last command
  bool egg_in_gripper_ = false;
  std::optional<Time> heard_;
};

}  // namespace coop::arm_driver
