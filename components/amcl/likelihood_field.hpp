#pragma once
#include <vector>

#include "amcl/beams.hpp"
#include "amcl/particle_set.hpp"
#include "core/config/fields.hpp"
#include "core/grid.hpp"

namespace coop::amcl {

struct LikelihoodFieldConfig {
  double hit_stddev = 0.08;    ///< m, of a beam's end about the surface it hit, map errors included
  double hit_weight = 0.7;     ///< share of beams that hit what the map shows
  double random_weight = 0.3;  ///< share of beams that end anywhere (animals, dust)
  double random_range = 12.0;  ///< m, a random beam's end is uniform over this length
  int occupied_percent = 65;   ///< a cell is an obstacle from this occupancy on

  void describe(config::Fields& fields);
};

/// How well beam ends fit a map: the likelihood field of Thrun, Burgard and Fox (Probabilistic
/// Robotics, 2005, section 6.4, table 6.3), with the exact Euclidean distance to the nearest
/// obstacle. The likelihood of an end at distance d is
///   hit_weight * N(d; 0, hit_stddev) + random_weight / random_range,
/// with the density of a perfect hit scaled to 1. In unknown space it is at least 1 / random_range;
/// not exactly that, as there, because a beam that ends a little behind a wall's surface ends in
/// unknown space. The logarithm is tabled once a cell, so that a beam costs one load.
class LikelihoodField {
 public:
  LikelihoodField(const LikelihoodFieldConfig& config, const OccupancyGrid& map);

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }

  /// Log-likelihood of one beam that ends at the point (m, map frame), at most 0. Outside the map
  /// as in unknown space.
  [[nodiscard]] float log_likelihood(const Eigen::Vector2d& point) const;

  /// Sets scores[i] to the mean log-likelihood of the beams seen from particle i: the logarithm of
  /// the beams' geometric mean, which does not depend on how many they are. `ends` must not be
  /// empty.
  void score(const ParticleSet& particles, const BeamEnds& ends, std::vector<float>& scores);

 private:
  GridGeometry geometry_;
  int stride_ = 0;            ///< width of the table: the map and a border of one cell
  std::vector<float> table_;  ///< log-likelihood a cell, rows from the lower border up
  BeamEnds ends_in_cells_;    ///< scratch
};

}  // namespace coop::amcl
