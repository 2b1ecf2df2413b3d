#pragma once
#include <vector>

#include "core/config/fields.hpp"
#include "slam/tile_map.hpp"

namespace coop::slam {

struct MatchFieldConfig {
  double sigma = 0.075;              ///< m, deviation of a beam's end from the wall
  double outlier_share = 0.1;        ///< of the beams that end anywhere
  double reach = 0.25;               ///< m, beyond it an end counts as an outlier
  double occupied_threshold = 0.25;  ///< share of hits from which a cell is a wall

  void describe(config::Fields& fields);
};

/// log p(beam's end | map) over a window of a map, smooth in between: the distance from each cell's
/// centre to the nearest mean of beam ends in the map, through log((1 - o) exp(-d^2 / 2 sigma^2) +
/// o), interpolated bilinearly. Built per particle and scan from the tiles the window covers.
class MatchField {
 public:
  explicit MatchField(const MatchFieldConfig& config);

  /// Window of all cells from `low` to `high` inclusive.
  void build(const TileMap& map, Cell low, Cell high);

  /// Value at a point of the map in cells (m / resolution); that of an outlier outside of the
  /// window.
  [[nodiscard]] float at(float x, float y) const {
    const float u = x - origin_x_;
    const float v = y - origin_y_;
    // Negated so that NaN is outside, too.
    if (!(u >= 0.0F && v >= 0.0F && u < limit_x_ && v < limit_y_)) return outlier_;
    const int column = static_cast<int>(u);
    const int row = static_cast<int>(v);
    const float a = u - static_cast<float>(column);
    const float b = v - static_cast<float>(row);
    const float* p = values_.data() + static_cast<std::size_t>(row * width_ + column);
    const float lower = p[0] + a * (p[1] - p[0]);
    const float upper = p[width_] + a * (p[width_ + 1] - p[width_]);
    return lower + b * (upper - lower);
  }
  [[nodiscard]] float outlier() const { return outlier_; }
  /// Walls within the window: none means that there is nothing to match against.
  [[nodiscard]] std::size_t wall_cells() const { return wall_cells_; }

 private:
  void stamp(float x, float y);

  MatchFieldConfig config_;
  float outlier_;
  int width_ = 0;
  int height_ = 0;
  float origin_x_ = 0.0F;  ///< cells, centre of the window's first cell
  float origin_y_ = 0.0F;
  float limit_x_ = 0.0F;
  float limit_y_ = 0.0F;
  int radius_ = 0;  ///< cells
  float reach_squared_ = 0.0F;
  std::size_t wall_cells_ = 0;
  std::vector<float> values_;  ///< squared distance while being built, then the logarithm
  std::vector<float> table_;   ///< of the squared distance
};

}  // namespace coop::slam
