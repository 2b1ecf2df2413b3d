#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/grid.hpp"

namespace coop {

/// Cells from `low` up to, not including, `high`.
struct CellWindow {
  Cell low;
  Cell high;
};

/// Cells of row y from `first` up to, not including, `last`.
struct CellRun {
  int y;
  int first;
  int last;
};

/// Exact Euclidean distance transform: for each cell the squared distance, in cells, from its
/// centre to the centre of the nearest source cell. Linear in the number of cells: distances along
/// columns, then the lower envelope of one parabola a column along each row (Felzenszwalb and
/// Huttenlocher 2012; Meijster, Roerdink and Hesselink 2000). Under a small cap the rows are
/// done by looking left and right as far as a nearer source may lie, 16 cells at a time.
///
/// The object keeps its work space: repeated runs on grids that are no larger do not allocate.
class DistanceTransform {
 public:
  /// Largest cap, and the cap that means "none" for every grid whose sides are at most this long.
  static constexpr int kNoCap = 32767;
  /// Up to here squared distances are added in 16 bits, and update() measures only what changed.
  static constexpr int kSmallCap = 127;

  /// `sources` holds 0 or 1 for each cell, row by row (width * height values); `squared_cells` as
  /// many results. A cell that is farther than `cap` cells from every source, or has none at all,
  /// gets cap * cap. Results below that are exact. A cap makes the run faster. Precondition: 1 <=
  /// cap <= kNoCap.
  void run(std::span<const std::uint8_t> sources, int width, int height,
           std::span<std::int32_t> squared_cells, int cap = kNoCap);

  /// As run() again with the same sizes and cap, `squared_cells` being its result (or update()'s),
  /// after sources have changed within the windows and nowhere else. The result is the same to the
  /// bit. Returns the runs that were measured anew, valid until the next call.
  std::span<const CellRun> update(std::span<const std::uint8_t> sources,
                                  std::span<const CellWindow> changed,
                                  std::span<std::int32_t> squared_cells);

 private:
  struct Parabola {
    std::int32_t vertex;
    std::int32_t height;
    double from;  ///< it is the lowest one from this abscissa on
  };

  void measure_columns(std::span<const std::uint8_t> sources);
  void measure_row(const std::uint16_t* column_distance, std::int32_t* squared);
  void measure_run(const std::uint16_t* column_distance, std::int32_t* squared, int first,
                   int last);
  void update_columns(std::span<const std::uint8_t> sources, const CellWindow& window);
  void mark(int y, int first, int last);
  void collect_runs();

  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint16_t> column_distance_;
  std::vector<Parabola> envelope_;
  std::vector<double> half_inverse_;  ///< 1 / (2 d) for a distance d between two vertices
  std::int32_t cap_ = kNoCap;
  // For small caps.
  std::vector<std::int16_t> squares_;   ///< of a row's column distances, with a margin
  std::vector<std::uint8_t> near_;      ///< 1: the block's columns hold a source within the cap
  std::vector<std::uint16_t> columns_;  ///< new column distances of a window
  std::vector<std::uint8_t> reach_;     ///< how far along a row a column distance is felt
  std::vector<std::uint64_t> stale_;    ///< a bit a block to be measured anew, whole words a row
  std::vector<CellRun> runs_;
};

/// Distance in metres from each cell's centre to the centre of the nearest cell whose occupancy is
/// at least `occupied_from` (percent; unknown cells are no sources), at most `max_distance`.
[[nodiscard]] Grid<float> distance_to_occupied(
    const OccupancyGrid& map, double max_distance = std::numeric_limits<double>::infinity(),
    std::int8_t occupied_from = 65);

}  // namespace coop
