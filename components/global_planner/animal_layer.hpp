#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "core/costmap/animal_tracks.hpp"
#include "core/costmap/footprint.hpp"
#include "core/grid.hpp"
#include "core/pose.hpp"

namespace coop::global_planner {

struct AnimalLayerConfig : AnimalTracksConfig {
  double horizon = 1.0;  ///< s: an animal's way is predicted so far ahead

  void describe(config::Fields& fields);
};

/// Animals with where they are about to go: each covers the cells it will stand on within the
/// horizon if it walks on as it did. The laser's layer knows only where they are.
class AnimalLayer {
 public:
  explicit AnimalLayer(const AnimalLayerConfig& config)
      : horizon_(config.horizon), tracks_(config) {}

  /// As AnimalTracks::see().
  [[nodiscard]] bool see(const std::vector<Detection>& animals, Time stamp) {
    return tracks_.see(animals, stamp);
  }
  [[nodiscard]] std::span<const AnimalTracks::Animal> animals() const { return tracks_.animals(); }

  /// Adds the cells that animals cover between `now` and the horizon, some more than once, but none
  /// under the robot's footprint, where it is known: an animal stops before the robot.
  void cover(const GridGeometry& grid, Time now, const std::optional<Pose2>& robot_in_map,
             const Footprint& footprint, std::vector<std::size_t>& cells) const;

 private:
  double horizon_;
  AnimalTracks tracks_;
};

}  // namespace coop::global_planner
