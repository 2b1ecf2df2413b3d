#pragma once
#include <string_view>
#include <vector>

#include "arm_driver/kinematic_chain.hpp"
#include "core/result.hpp"

namespace coop::arm_driver {

/// Where the tip is to be: its origin at `position`, its z axis along `direction` (unit vector),
/// its turn about that axis free. In the chain's reference frame.
struct TipTarget {
  Eigen::Vector3d position{0, 0, 0};  ///< m
  Eigen::Vector3d direction{0, 0, -1};
};

enum class IkError {
  kOutOfReach,  ///< not even joints without limits would take the tip there
  kJointLimit,  ///< only joints without limits would
};
[[nodiscard]] std::string_view to_string(IkError error);

struct IkConfig {
  double position_tolerance = 1e-4;   ///< m
  double direction_tolerance = 1e-3;  ///< rad
  double damping = 0.02;              ///< lambda of the least squares, m/rad
  double direction_weight = 0.3;      ///< m an error of 1 rad counts for
  double max_step = 0.5;              ///< rad, longest step of an iteration
  int max_iterations = 120;           ///< of one start
  int extra_starts = 24;              ///< tried after the seeds, spread over the joints' range
};

/// Numerical inverse kinematics by damped least squares (Wampler 1986; Nakamura and Hanafusa 1986):
///   dq = J^T (J J^T + lambda^2 I)^-1 e
/// with joints clamped to their limits in every iteration, from several starts: the seeds, then
/// points of a Halton sequence over the joints' range, so that one target has one answer. Deviation
/// from the papers: lambda is constant, but shrinks with the error, which keeps the last steps
/// quadratic away from singular poses.
class InverseKinematics {
 public:
  explicit InverseKinematics(const KinematicChain& chain, const IkConfig& config = {});

  /// The solution reached from `seed` where there is one; otherwise, of those reached from the
  /// other starts, that nearest to `seed` (by the largest joint movement).
  [[nodiscard]] Result<JointVector, IkError> solve(const TipTarget& target,
                                                   const JointVector& seed) const;

  [[nodiscard]] const KinematicChain& chain() const { return chain_; }

 private:
  [[nodiscard]] bool descend(const TipTarget& target, bool limited, JointVector& positions) const;

  KinematicChain chain_;
  IkConfig config_;
  std::vector<JointVector> starts_;
};

}  // namespace coop::arm_driver
