#pragma once
#include <array>
#include <cstddef>

#include "core/pose.hpp"

namespace coop::global_planner {

/// Part of a path at constant curvature, driven in one direction.
struct Arc {
  double length = 0.0;     ///< m, negative: backwards
  double curvature = 0.0;  ///< 1/m, positive: to the left when driving forwards
};

/// Up to five arcs that lead from one pose to another.
struct ArcPath {
  std::array<Arc, 5> arcs{};
  std::size_t count = 0;

  [[nodiscard]] double length() const;        ///< m, both directions counted positive
  [[nodiscard]] Pose2 end(Pose2 from) const;  ///< where the arcs lead
};

/// All Reeds-Shepp words from one pose to another: the shortest paths of a car that drives both
/// ways and turns with at least the given radius are among them (Reeds and Shepp 1990: Optimal
/// paths for a car that goes both forwards and backwards; their formulas 8.1 to 8.11 with the
/// symmetries by time flip, reflection and reversal).
class ReedsShepp {
 public:
  static constexpr std::size_t kMaxWords = 48;

  explicit ReedsShepp(double turning_radius) : radius_(turning_radius) {}

  struct Words {
    std::array<ArcPath, kMaxWords> paths{};
    std::size_t count = 0;
  };
  /// Fills `words`; there always is at least one. No allocation.
  void connect(const Pose2& from, const Pose2& to, Words& words) const;

  /// Length of the shortest word, m.
  [[nodiscard]] double distance(const Pose2& from, const Pose2& to) const;

  [[nodiscard]] double turning_radius() const { return radius_; }

 private:
  double radius_;
};

}  // namespace coop::global_planner
