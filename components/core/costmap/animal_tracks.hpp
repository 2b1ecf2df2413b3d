#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/config/fields.hpp"
#include "core/detection.hpp"
#include "core/time.hpp"

namespace coop {

struct AnimalTracksConfig {
  double spread = 0.1;          ///< m/s by which an animal may stray from the prediction
  double max_age = 1.0;         ///< s without being seen, then it is forgotten
  double same_animal = 0.4;     ///< m from where it was predicted: it is the same one
  double max_speed = 1.5;       ///< m/s, of an animal; estimates do not exceed it
  double responsiveness = 0.4;  ///< share of a new measurement in the velocity, 0 to 1

  void describe(config::Fields& fields);
};

/// Animals that an overhead camera sees, and how they move. Velocities are estimated from sightings
/// alone (alpha-beta filter with alpha 1: positions are good, velocities are not).
class AnimalTracks {
 public:
  explicit AnimalTracks(const AnimalTracksConfig& config) : config_(config) {}

  struct Animal {
    Time stamp{};  ///< last seen
    Eigen::Vector2d center_in_map{0, 0};
    Eigen::Vector2d velocity_in_map{0, 0};  ///< m/s
    double radius = 0.0;                    ///< m
  };

  /// More than any pen holds; the work grows with their square.
  static constexpr std::size_t kMaxAnimals = 256;

  /// All animals in view at `stamp`; a list older than the last one is ignored. False, and nothing
  /// of it is taken, where there are more than kMaxAnimals.
  [[nodiscard]] bool see(const std::vector<Detection>& animals, Time stamp);
  [[nodiscard]] std::span<const Animal> animals() const { return animals_; }

  /// Whether it was seen not too long before `now` to be reckoned with.
  [[nodiscard]] bool is_known(const Animal& animal, Time now) const {
    const double age = to_seconds(now - animal.stamp);
    return age >= 0.0 && age <= config_.max_age;
  }
  /// The disc it is taken to be within, `seconds` after it was seen, if it walks on as it did.
  struct Disc {
    Eigen::Vector2d center{0, 0};
    double radius = 0.0;
  };
  [[nodiscard]] Disc predicted(const Animal& animal, double seconds) const {
    return {animal.center_in_map + seconds * animal.velocity_in_map,
            animal.radius + config_.spread * seconds};
  }

 private:
  [[nodiscard]] Animal* nearest(const Eigen::Vector2d& seen, Time stamp,
                                const std::vector<std::uint8_t>& taken);
  void follow(Animal& animal, const Eigen::Vector2d& seen, Time stamp) const;

  AnimalTracksConfig config_;
  std::vector<Animal> animals_;
  Time last_{};
};

}  // namespace coop
