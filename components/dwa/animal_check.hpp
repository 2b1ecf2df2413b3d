#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/costmap/animal_tracks.hpp"
#include "core/costmap/footprint.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"
#include "dwa/config.hpp"
#include "dwa/prediction.hpp"

namespace coop::dwa {

/// Whether a trajectory leads into an animal that walks on as it did: the footprint at each pose
/// against the disc the animal is taken to be within at that pose's time. What the laser sees of it
/// stands still in the local map.
///
/// An animal that the robot touches already may be left, but not approached any further.
class AnimalCheck {
 public:
  /// `footprint` with its padding; `step`: s between the poses of a trajectory.
  AnimalCheck(const AnimalCheckConfig& config, const Footprint& footprint, double step);

  /// As AnimalTracks::see(), in map.
  [[nodiscard]] bool see(const std::vector<Detection>& animals, Time stamp) {
    return tracks_.see(animals, stamp);
  }

  /// The control step at `now`: where the animals are, seen from the robot's frame odom.
  void place(const Pose2& base_in_odom, const Pose2& odom_in_map, Time now);

  /// Poses in odom, the first one step after `now`.
  [[nodiscard]] bool collides(const Trajectory& trajectory) const;

 private:
  struct Walker {
    Eigen::Vector2d center{0, 0};    ///< in odom, now
    Eigen::Vector2d velocity{0, 0};  ///< m/s, in odom
    double radius = 0.0;             ///< m, now
    double gap = 0.0;                ///< m from the footprint, now; negative: touched
  };
  [[nodiscard]] double gap(const Pose2& base, const Eigen::Vector2d& center, double radius) const;
  [[nodiscard]] bool hits(const Walker& walker, const Pose2& base, double seconds) const;

  AnimalCheckConfig config_;
  Footprint footprint_;
  double step_;
  AnimalTracks tracks_;
  std::vector<Walker> walkers_;
};

}  // namespace coop::dwa
