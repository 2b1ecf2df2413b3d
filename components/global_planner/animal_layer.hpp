#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/config/fields.hpp"
#include "core/costmap/footprint.hpp"
#include "core/detection.hpp"
#include "core/grid.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace coop::global_planner {

struct AnimalLayerConfig {
  double horizon = 1.0;         ///< s: an animal's way is predicted so far ahead
  double spread = 0.1;          ///< m/s by which it may stray from the prediction to any side
  double max_age = 1.0;         ///< s without being seen, then it is forgotten
  double same_animal = 0.4;     ///< m from where it was predicted: it is the same one
  double max_speed = 1.5;       ///< m/s, of an animal; estimates do not exceed it
  double responsiveness = 0.4;  ///< share of a new measurement in the velocity, 0 to 1

  void describe(config::Fields& fields);
};

/// Animals with where they are about to go: each covers the cells it will stand on within the
/// horizon if it walks on as it did. The laser's layer knows only where they are.
///
/// Velocities are estimated from sightings alone (alpha-beta filter with alpha 1: positions are
/// good, velocities are not).
class AnimalLayer {
 public:
  explicit AnimalLayer(const AnimalLayerConfig& config) : config_(config) {}

  struct Animal {
    Time stamp{};  ///< last seen
    Eigen::Vector2d center_in_map{0, 0};
    Eigen::Vector2d velocity_in_map{0, 0};  ///< m/s
    double radius = 0.0;                    ///< m
  };

  /// All animals in view at `stamp`; a list older than the last one is ignored.
  void see(const std::vector<Detection>& animals, Time stamp);
  [[nodiscard]] std::span<const Animal> animals() const { return animals_; }

  /// Marks the cells (1 a cell of the grid) that animals cover between `now` and the horizon, but
  /// none under the robot's footprint, where it is known: an animal stops before the robot.
  void mark(const GridGeometry& grid, Time now, const std::optional<Pose2>& robot_in_map,
            const Footprint& footprint, std::span<std::uint8_t> cells) const;

 private:
  [[nodiscard]] Animal* nearest(const Eigen::Vector2d& seen, Time stamp,
                                const std::vector<std::uint8_t>& taken);
  static void follow(Animal& animal, const Eigen::Vector2d& seen, Time stamp,
                     const AnimalLayerConfig& config);

  AnimalLayerConfig config_;
  std::vector<Animal> animals_;
  Time last_{};
};

}  // namespace coop::global_planner
