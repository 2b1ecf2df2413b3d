#pragma once
#include <cstdint>
#include <vector>

#include "core/pose.hpp"
#include "slam/scan_points.hpp"
#include "slam/tile_map.hpp"

namespace coop::slam {

/// Draws scans into maps. Within one scan a cell is passed at most once, however many beams cross
/// it, and a cell in which a beam ends is not passed: grazing beams would otherwise eat walls.
/// Holds scratch space: one per worker.
class MapUpdater {
 public:
  void integrate(TileMap& map, const ScanPoints& points, const Pose2& base_in_map);

 private:
  void place_window(const TileMap& map, Cell laser, const ScanPoints& points,
                    const Pose2& base_in_map);
  void mark_line(Cell from, Cell to);
  void apply_passes(TileMap& map) const;
  void apply_hits(TileMap& map) const;
  [[nodiscard]] std::size_t index(Cell cell) const {
    return static_cast<std::size_t>(cell.y - low_.y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(cell.x - low_.x);
  }

  Cell low_;       ///< corner of the window of cells that the scan touches, on a tile's corner
  int width_ = 0;  ///< cells, whole tiles
  int height_ = 0;
  std::vector<std::uint8_t> marks_;
  std::vector<Eigen::Vector2d> ends_in_map_;
  std::vector<Eigen::Vector2d> open_ends_in_map_;
};

}  // namespace coop::slam
