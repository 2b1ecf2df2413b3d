#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/grid.hpp"

namespace coop {

/// Exact Euclidean distance transform: for each cell the squared distance, in cells, from its
/// centre to the centre of the nearest source cell. Linear in the number of cells: distances along
/// columns, then the lower envelope of one parabola a column along each row (Felzenszwalb and
/// Huttenlocher 2012; Meijster, Roerdink and Hesselink 2000).
///
/// The object keeps its work space: repeated runs on grids that are no larger do not allocate.
class DistanceTransform {
 public:
  /// Largest cap, and the cap that means "none" for every grid whose sides are at most this long.
  static constexpr int kNoCap = 32767;

  /// `sources` holds 0 or 1 for each cell, row by row (width * height values); `squared_cells` as
  /// many results. A cell that is farther than `cap` cells from every source, or has none at all,
  /// gets cap * cap. Results below that are exact. A cap makes the run faster. Precondition: 1 <=
  /// cap <= kNoCap.
  void run(std::span<const std::uint8_t> sources, int width, int height,
           std::span<std::int32_t> squared_cells, int cap = kNoCap);

 private:
  struct Parabola {
    std::int32_t vertex;
    std::int32_t height;
    double from;  ///< it is the lowest one from this abscissa on
  };

  void measure_columns(std::span<const std::uint8_t> sources, int width, int height);
  void measure_row(const std::uint16_t* column_distance, int width, std::int32_t* squared);

  std::vector<std::uint16_t> column_distance_;
  std::vector<Parabola> envelope_;
  std::vector<double> half_inverse_;  ///< 1 / (2 d) for a distance d between two vertices
  std::int32_t cap_ = kNoCap;
};

/// Distance in metres from each cell's centre to the centre of the nearest cell whose occupancy is
/// at least `occupied_from` (percent; unknown cells are no sources), at most `max_distance`.
[[nodiscard]] Grid<float> distance_to_occupied(
    const OccupancyGrid& map, double max_distance = std::numeric_limits<double>::infinity(),
    std::int8_t occupied_from = 65);

}  // namespace coop
