#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "arm_driver/pick_sequence.hpp"
#include "arm_driver/simulated_arm.hpp"
#include "unit/arm_driver/arms.hpp"

namespace coop::arm_driver::test {

/// A pick sequence that drives the simulated arm over a floor with one egg at `egg`, in steps of
/// 20 ms. The sequence may be put to death and born again; arm and egg stay.
class BenchArm {
 public:
  static constexpr double kStep = 0.02;
  static constexpr double kCapture = 0.025;  // m around the egg at which it is taken up

  explicit BenchArm(const PickSequenceConfig& config = {})
      : config_(config),
        arm_(motion_.chain(), motion_.home()),
        sequence_(std::make_unique<PickSequence>(config_, motion_)) {}

  Eigen::Vector2d egg{0.92, 0.0};
  bool egg_exists = true;
  bool held = false;    ///< the egg hangs on the cup
  bool reading = true;  ///< the vacuum is measured
  bool stop = false;
  bool jammed = false;  ///< the joints do not move
  int taken = 0;        ///< times an egg was taken up
  int eggs_in_basket = 0;
  double time = 100.0;            ///< s
  std::vector<PickOrder> orders;  ///< for the next step
  std::vector<PickReport> reports;

  void order(const std::string& pick_id) { orders.push_back({pick_id, "egg", egg}); }

  const ArmOutputs& step() {
    time += kStep;
    const Time now = time_from_seconds(time);
    if (reading) arm_.hear_truth(held, now);
    const ArmReading measured = arm_.read(now);
    const ArmOutputs& outputs =
        sequence_->step({measured.positions, measured.suction,
                         reading ? measured.vacuum : std::nullopt, stop, orders},
                        now);
    orders.clear();
    if (outputs.record_changed) disk_ = sequence_->record();
    arm_.command(jammed ? measured.positions : outputs.target, outputs.suction, now);
    reports.insert(reports.end(), outputs.reports.begin(), outputs.reports.end());
    let_egg_follow(outputs.suction);
    return outputs;
  }

  /// False when `limit` s passed before the condition held.
  bool run_until(const std::function<bool()>& condition, double limit = 30.0) {
    const double end = time + limit;
    while (!condition()) {
      if (time > end) return false;
      step();
    }
    return true;
  }
  bool run_to(PickSequence::Phase phase, double limit = 30.0) {
    return run_until([&] { return sequence_->phase() == phase; }, limit);
  }
  bool run_to_report(double limit = 60.0) {
    const std::size_t before = reports.size();
    return run_until([&] { return reports.size() > before; }, limit);
  }
  void run_for(double duration) {
    run_until([end = time + duration, this] { return time >= end; }, duration + 1.0);
  }

  /// The driver dies and starts again with what was on disk.
  void restart() {
    sequence_ = std::make_unique<PickSequence>(config_, motion_, disk_);
    reports.clear();
  }

  [[nodiscard]] const PickSequence& sequence() const { return *sequence_; }
  [[nodiscard]] const ArmMotion& motion() const { return motion_; }
  [[nodiscard]] ArmReading arm() { return arm_.read(time_from_seconds(time)); }
  [[nodiscard]] Eigen::Vector3d tip() { return motion_.tip(arm().positions); }
  [[nodiscard]] const PickRecord& disk() const { return disk_; }

 private:
  void let_egg_follow(bool suction) {
    const Eigen::Vector3d cup = tip();
    if (held && !suction) {
      held = false;
      const Eigen::Vector3d basket = motion_.tip(motion_.at_basket());
      if ((cup - basket).norm() < 0.05) ++eggs_in_basket;
      egg_exists = false;
    } else if (!held && suction && egg_exists && (cup.head<2>() - egg).norm() < kCapture &&
               cup.z() < 0.06) {
      held = true;
      ++taken;
    }
  }

  static const ArmMotion& shared_motion() {
    static const ArmMotion motion(collector(), {});
    return motion;
  }

  const ArmMotion& motion_ = shared_motion();
  PickSequenceConfig config_;
  SimulatedArm arm_;
  PickRecord disk_;
  std::unique_ptr<PickSequence> sequence_;
};

}  // namespace coop::arm_driver::test
