#pragma once
#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/grid.hpp"

namespace coop::slam {

/// What is known of one cell: how often a beam ended in it or passed through it, and where in it
/// the ends lie.
struct MapCell {
  std::uint16_t hits = 0;
  std::uint16_t visits = 0;  ///< hits and passes
  float mean_x = 0.0F;       ///< m, mean of the ends, from the cell's lower left corner
  float mean_y = 0.0F;

  [[nodiscard]] bool is_known() const { return visits > 0; }
  /// Share of the visits that ended here; 0 where unknown.
  [[nodiscard]] float occupancy() const {
    return visits > 0 ? static_cast<float>(hits) / static_cast<float>(visits) : 0.0F;
  }
  void add_hit(float x, float y);
  void add_pass() {
    if (visits < UINT16_MAX) ++visits;
  }
};

inline constexpr int kTileShift = 5;
inline constexpr int kTileSide = 1 << kTileShift;  ///< cells

/// A square of cells, shared by the maps that agree on it.
struct Tile {
  std::array<MapCell, kTileSide * kTileSide> cells{};  ///< row-major
  std::atomic<int> owners{1};

  [[nodiscard]] MapCell& at(int x, int y) { return cells[offset(x, y)]; }
  [[nodiscard]] const MapCell& at(int x, int y) const { return cells[offset(x, y)]; }

 private:
  static std::size_t offset(int x, int y) {
    return static_cast<std::size_t>((y & (kTileSide - 1)) << kTileShift | (x & (kTileSide - 1)));
  }
};

/// Counted reference to a tile. std::shared_ptr would do but for its use_count(), which may not be
/// relied on to see that this thread is the only owner.
class TileRef {
 public:
  TileRef() = default;
  TileRef(const TileRef& other) : tile_(other.tile_) {
    if (tile_) tile_->owners.fetch_add(1, std::memory_order_relaxed);
  }
  TileRef(TileRef&& other) noexcept : tile_(std::exchange(other.tile_, nullptr)) {}
  TileRef& operator=(TileRef other) noexcept {
    std::swap(tile_, other.tile_);
    return *this;
  }
  ~TileRef() {
    if (tile_ && tile_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete tile_;
  }
  [[nodiscard]] const Tile* get() const { return tile_; }
  [[nodiscard]] bool is_shared() const {
    return tile_ && tile_->owners.load(std::memory_order_acquire) > 1;
  }
  /// The tile for writing: made where there is none, copied first where others hold it too.
  Tile& writable();

 private:
  Tile* tile_ = nullptr;
};

/// Grid of unlimited extent around the frame's origin, of which only the tiles written to exist. A
/// copy costs one counted reference a tile; a tile is copied when one of its holders writes to it.
/// Cell (0, 0) has its lower left corner in the origin; indices may be negative.
class TileMap {
 public:
  explicit TileMap(double resolution) : resolution_(resolution) {}

  [[nodiscard]] double resolution() const { return resolution_; }
  [[nodiscard]] Cell cell_of(const Eigen::Vector2d& point) const {
    return {static_cast<int>(std::floor(point.x() / resolution_)),
            static_cast<int>(std::floor(point.y() / resolution_))};
  }
  /// The cell, or an unknown one where nothing was written.
  [[nodiscard]] const MapCell& at(Cell cell) const;
  /// Tile that holds the cell, or null.
  [[nodiscard]] const Tile* tile_at(Cell cell) const;
  /// Tile that holds the cell, for writing; the map grows as needed.
  Tile& writable_tile_at(Cell cell);

  /// Calls visit(corner, tile) for every tile there is; `corner` is its first cell.
  template <class Visit>
  void for_each_tile(Visit&& visit) const {
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      const Tile* tile = tiles_[i].get();
      if (!tile) continue;
      const int slot_number = static_cast<int>(i);
      visit(Cell{(first_x_ + slot_number % columns_) << kTileShift,
                 (first_y_ + slot_number / columns_) << kTileShift},
            *tile);
    }
  }

  [[nodiscard]] std::size_t tile_count() const;
  /// Tiles that other maps hold as well.
  [[nodiscard]] std::size_t shared_tile_count() const;

  /// Occupancy of all tiles: kOccupied where the share of hits is at least `threshold`, kFree
  /// below, kUnknown where never visited. Cropped to what is known plus `margin` cells.
  [[nodiscard]] OccupancyGrid to_occupancy_grid(double threshold, int margin) const;

 private:
  [[nodiscard]] bool has_slot(int tile_x, int tile_y) const {
    return tile_x >= first_x_ && tile_y >= first_y_ && tile_x < first_x_ + columns_ &&
           tile_y < first_y_ + rows_;
  }
  [[nodiscard]] std::size_t slot(int tile_x, int tile_y) const {
    return static_cast<std::size_t>(tile_y - first_y_) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(tile_x - first_x_);
  }
  void grow_to(int tile_x, int tile_y);

  double resolution_;
  int first_x_ = 0;  ///< tile column of the directory's first slot
  int first_y_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<TileRef> tiles_;  ///< directory, row-major
};

}  // namespace coop::slam
