#include "arm_driver/inverse_kinematics.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace coop::arm_driver {
namespace {

using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Element `index` (from 1) of the van der Corput sequence, in (0, 1).
double radical_inverse(int index, int base) {
  double value = 0.0;
  double digit = 1.0;
  for (; index > 0; index /= base) {
    digit /= base;
    value += digit * (index % base);
  }
  return value;
}

std::vector<JointVector> halton_starts(const KinematicChain& chain, int count) {
  constexpr std::array<int, kMaxJoints> kPrimes{2, 3, 5, 7, 11, 13, 17, 19};
  std::vector<JointVector> starts;
  for (int n = 1; n <= count; ++n) {
    JointVector start(chain.size());
    for (int i = 0; i < chain.size(); ++i) {
      const double low = std::max(chain.lower()[i], -std::numbers::pi);
      const double high = std::min(chain.upper()[i], std::numbers::pi);
      start[i] = low + (high - low) * radical_inverse(n, kPrimes[static_cast<std::size_t>(i)]);
    }
    starts.push_back(start);
  }
  return starts;
}

/// Turn that takes unit vector `from` to unit vector `to`, as axis times angle.
Vector3d turn_between(const Vector3d& from, const Vector3d& to) {
  const Vector3d cross = from.cross(to);
  const double sine = cross.norm();
  const double angle = std::atan2(sine, from.dot(to));
  if (sine > 1e-9) return cross * (angle / sine);
  return angle < 1.0 ? Vector3d::Zero() : Vector3d(from.unitOrthogonal() * angle);
}

}  // namespace

std::string_view to_string(IkError error) {
  return error == IkError::kOutOfReach ? "out of reach" : "beyond the limit of a joint";
}

InverseKinematics::InverseKinematics(const KinematicChain& chain, const IkConfig& config)
    : chain_(chain), config_(config), starts_(halton_starts(chain, config.extra_starts)) {}

bool InverseKinematics::descend(const TipTarget& target, bool limited,
                                JointVector& positions) const {
  constexpr int kPatience = 12;  // iterations without progress after which the start is given up
  JacobianMatrix jacobian;
  double best = std::numeric_limits<double>::infinity();
  int best_iteration = 0;
  for (int iteration = 0; iteration < config_.max_iterations; ++iteration) {
    const Pose3 tip = chain_.tip_in_reference(positions, jacobian);
    const Vector3d axis = tip.linear().col(2);
    const Vector3d offset = target.position - tip.translation();
    const Vector3d turn = turn_between(axis, target.direction);
    if (offset.norm() < config_.position_tolerance && turn.norm() < config_.direction_tolerance) {
      return true;
    }
    Vector6d error;
    error << offset, config_.direction_weight * turn;
    if (error.norm() < 0.98 * best) {
      best = error.norm();
      best_iteration = iteration;
    } else if (iteration - best_iteration > kPatience) {
      return false;
    }
    // The turn about the tip's own axis is free: it does not count.
    for (int i = 0; i < chain_.size(); ++i) {
      Vector3d spin = jacobian.col(i).tail<3>();
      spin -= axis * axis.dot(spin);
      jacobian.col(i).tail<3>() = config_.direction_weight * spin;
    }
    const double lambda = config_.damping * std::min(1.0, error.norm() / 0.1) + 1e-5;
    Matrix6d damped = jacobian * jacobian.transpose();
    damped.diagonal().array() += lambda * lambda;
    JointVector step = jacobian.transpose() * damped.ldlt().solve(error);
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest > config_.max_step) step *= config_.max_step / longest;
    positions += step;
    if (limited) positions = positions.cwiseMax(chain_.lower()).cwiseMin(chain_.upper());
  }
  return false;
}

Result<JointVector, IkError> InverseKinematics::solve(const TipTarget& target,
                                                      const JointVector& seed) const {
  JointVector positions = seed.cwiseMax(chain_.lower()).cwiseMin(chain_.upper());
  if (descend(target, true, positions)) return positions;
  std::optional<JointVector> best;
  double best_movement = 0.0;
  for (const JointVector& start : starts_) {
    positions = start;
    if (!descend(target, true, positions)) continue;
    const double movement = (positions - seed).cwiseAbs().maxCoeff();
    if (best && movement >= best_movement) continue;
    best = positions;
    best_movement = movement;
  }
  if (best) return *best;
  positions = seed;
  if (descend(target, false, positions)) return fail(IkError::kJointLimit);
  for (const JointVector& start : starts_) {
    positions = start;
    if (descend(target, false, positions)) return fail(IkError::kJointLimit);
  }
  return fail(IkError::kOutOfReach);
}

}  // namespace coop::arm_driver
