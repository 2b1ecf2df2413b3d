#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "arm_driver/arm_motion.hpp"
#include "arm_driver/pick_record.hpp"
#include "core/time.hpp"

namespace coop::arm_driver {

struct PickSequenceConfig {
  double grip_time = 0.10;          ///< s of vacuum after which the egg is held
  double grip_timeout = 0.60;       ///< s without vacuum after which there is no egg here
  double release_time = 0.20;       ///< s that the cup stays over the basket
  double release_timeout = 2.0;     ///< s after which an egg that still holds is given up
  double loss_time = 0.20;          ///< s without vacuum after which a held egg is lost
  double reading_timeout = 3.0;     ///< s without a reading of the vacuum before a pick is aborted
  double arrival_tolerance = 0.01;  ///< rad
  double arrival_timeout = 2.0;     ///< s after a motion's end at which the arm must have arrived

  void describe(config::Fields& fields);
};

struct PickOrder {
  std::string pick_id;
  std::string egg_id;
  /// Of its centre, m; or why that is not known, which aborts the pick.
  Result<Eigen::Vector2d> egg_in_base{Eigen::Vector2d(0, 0)};
};

struct ArmInputs {
  JointVector positions;       ///< measured, rad
  bool suction = false;        ///< the pump runs
  std::optional<bool> vacuum;  ///< something closes the cup; nothing while that is not known
  bool emergency_stop = false;
  std::span<const PickOrder> orders;  ///< come since the last step
};

struct ArmOutputs {
  JointVector target;  ///< for the joints, rad
  bool suction = false;
  bool busy = false;  ///< on the way, or at work
  /// The record is to be on disk before the rest of the outputs takes effect: only then a driver
  /// that dies in between tells the truth in its next life.
  bool record_changed = false;
  std::vector<PickReport> reports;  ///< to be told
};

/// Picks eggs: above the egg, down, suction, up, over the basket, release, home; a search around
/// the place where nothing was found. A state machine without clock or device. An order is carried
/// out once: said again while it runs it goes on, said again after its end its result is repeated.
/// Another order while one runs is refused as busy. Results are told when the arm is home again, so
/// the base may drive then.
///
/// Under an emergency stop the joints stay where they are and the suction as it is; afterwards the
/// phase that was interrupted begins again from there. The same happens when time is set back. Time
/// that passes without steps (the driver was stopped) does not count: an egg on the cup stays
/// there.
class PickSequence {
 public:
  enum class Phase {
    kRecover,  ///< after the start: what of the record is still true?
    kIdle,
    kApproach,  ///< to above the next touch
    kDescend,
    kGrip,
    kBackOff,  ///< up a little, for the next touch
    kLift,     ///< up from the floor, with the egg or without
    kCarry,    ///< to above the basket
    kLower,
    kRelease,
    kHome,
  };

  /// `record`: what an earlier life left. `motion` must outlive the sequence.
  PickSequence(const PickSequenceConfig& config, const ArmMotion& motion, PickRecord record = {});

  /// The reference holds until the next call.
  const ArmOutputs& step(const ArmInputs& inputs, Time now);

  [[nodiscard]] const PickRecord& record() const { return record_; }
  [[nodiscard]] Phase phase() const { return phase_; }
  /// Is an order of that name running or ended, so that its position plays no part any more?
  [[nodiscard]] bool knows(std::string_view pick_id) const;

 private:
  void pass_over(Duration time);
  void take(const PickOrder& order);
  void start(const PickOrder& order);
  void enter(Phase phase);
  void run(const ArmInputs& inputs);
  void recover(const ArmInputs& inputs);
  void grip(const ArmInputs& inputs);
  void try_next_touch();
  void release(const ArmInputs& inputs);
  void watch_held_egg(const ArmInputs& inputs);
  void arrive();
  void finish(PickOutcome outcome, std::string detail);
  void conclude();
  void set_stage(PickStage stage);
  [[nodiscard]] JointTrajectory motion_of(Phase phase) const;
  [[nodiscard]] Eigen::Vector3d above(const Eigen::Vector3d& point, double height) const;
  [[nodiscard]] double seconds_in_phase() const { return to_seconds(now_ - since_); }
  [[nodiscard]] bool is_motion(Phase phase) const;
  [[nodiscard]] bool has_arrived() const;

  PickSequenceConfig config_;
  const ArmMotion& motion_;
  PickRecord record_;
  ArmOutputs out_;

  Time now_{};
  JointVector positions_;
  Phase phase_ = Phase::kRecover;
  Time since_{};           ///< begin of the phase
  Time vacuum_known_{};    ///< last time the vacuum was read
  Time vacuum_changed_{};  ///< since when the reading is what it is
  std::optional<bool> vacuum_;
  bool interrupted_ = false;
  JointTrajectory trajectory_;
  std::vector<Eigen::Vector3d> touches_;  ///< left to try, the next one last
  bool first_touch_ = true;
  std::optional<PickReport> ending_;  ///< decided, to be told at home
  std::optional<PickOrder> said_again_;
};

[[nodiscard]] std::string_view to_string(PickSequence::Phase phase);

}  // namespace coop::arm_driver
