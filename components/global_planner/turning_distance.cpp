#include "global_planner/turning_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coop::global_planner {
namespace {

constexpr double kCell = 0.2;  // m
constexpr int kHeadings = 36;
constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace

TurningDistance::TurningDistance(double turning_radius, double reach)
    : curves_(turning_radius), reach_(reach), side_(2 * static_cast<int>(reach / kCell) + 1) {
  table_.assign(static_cast<std::size_t>((side_ / 2 + 1) * side_ * kHeadings), -1.0F);
}

double TurningDistance::operator()(const Pose2& from, const Pose2& to) {
  const Pose2 relative = to.inverse() * from;
  if (std::abs(relative.x) >= reach_ || std::abs(relative.y) >= reach_) return 0.0;
  // A path and its mirror image are of one length, so half a table is enough.
  const double mirror = relative.y < 0.0 ? -1.0 : 1.0;
  const int half = static_cast<int>(reach_ / kCell);
  const int ix = static_cast<int>(std::lround(relative.x / kCell));
  const int iy = static_cast<int>(std::lround(mirror * relative.y / kCell));
  const int turns = static_cast<int>(std::lround(mirror * relative.yaw / kTurn * kHeadings));
  const int iyaw = (turns % kHeadings + kHeadings) % kHeadings;
  float& entry = table_[static_cast<std::size_t>((iy * side_ + ix + half) * kHeadings + iyaw)];
  if (entry < 0.0F) {
    const Pose2 rounded{ix * kCell, iy * kCell, normalize_angle(iyaw * kTurn / kHeadings)};
    entry = static_cast<float>(curves_.distance(rounded, {}));
  }
  return entry;
}

}  // namespace coop::global_planner
