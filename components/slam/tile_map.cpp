#include "slam/tile_map.hpp"

#include <algorithm>
#include <climits>
#include <tuple>

namespace coop::slam {
namespace {

constexpr int kGrowthMargin = 4;  ///< tiles added beyond the one asked for, so that growing is rare

const MapCell kUnknownCell{};

}  // namespace

void MapCell::add_hit(float x, float y) {
  if (visits == UINT16_MAX) return;
  ++visits;
  ++hits;
  const float weight = 1.0F / static_cast<float>(hits);
  mean_x += weight * (x - mean_x);
  mean_y += weight * (y - mean_y);
}

Tile& TileRef::writable() {
  if (!tile_) {
    tile_ = new Tile;
  } else if (is_shared()) {
    auto* copy = new Tile;
    copy->cells = tile_->cells;
    // Another holder may have let go meanwhile: then this was the last reference after all.
    if (tile_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete tile_;
    tile_ = copy;
  }
  return *tile_;
}

const Tile* TileMap::tile_at(Cell cell) const {
  const int x = cell.x >> kTileShift;
  const int y = cell.y >> kTileShift;
  return has_slot(x, y) ? tiles_[slot(x, y)].get() : nullptr;
}

const MapCell& TileMap::at(Cell cell) const {
  const Tile* tile = tile_at(cell);
  return tile ? tile->at(cell.x, cell.y) : kUnknownCell;
}

Tile& TileMap::writable_tile_at(Cell cell) {
  const int x = cell.x >> kTileShift;
  const int y = cell.y >> kTileShift;
  if (!has_slot(x, y)) grow_to(x, y);
  return tiles_[slot(x, y)].writable();
}

void TileMap::grow_to(int tile_x, int tile_y) {
  TileMap larger(resolution_);
  const bool empty = tiles_.empty();
  const auto span = [empty](int first, int count, int wanted) {
    int low = empty ? wanted - kGrowthMargin : first;
    int high = empty ? wanted + kGrowthMargin : first + count - 1;
    if (wanted < low) low = wanted - kGrowthMargin;
    if (wanted > high) high = wanted + kGrowthMargin;
    return std::pair{low, high - low + 1};
  };
  std::tie(larger.first_x_, larger.columns_) = span(first_x_, columns_, tile_x);
  std::tie(larger.first_y_, larger.rows_) = span(first_y_, rows_, tile_y);
  larger.tiles_.resize(static_cast<std::size_t>(larger.columns_) *
                       static_cast<std::size_t>(larger.rows_));
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      const int old_x = first_x_ + x;
      const int old_y = first_y_ + y;
      larger.tiles_[larger.slot(old_x, old_y)] = std::move(tiles_[slot(old_x, old_y)]);
    }
  }
  *this = std::move(larger);
}

std::size_t TileMap::tile_count() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(tiles_, [](const TileRef& tile) { return tile.get() != nullptr; }));
}

std::size_t TileMap::shared_tile_count() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(tiles_, [](const TileRef& tile) { return tile.is_shared(); }));
}

namespace {

struct Box {
  Cell low{INT_MAX, INT_MAX};
  Cell high{INT_MIN, INT_MIN};

  void include(Cell cell) {
    low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
    high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
  }
};

}  // namespace

OccupancyGrid TileMap::to_occupancy_grid(double threshold, int margin) const {
  const auto for_each_known = [this](auto&& visit) {
    for_each_tile([&](Cell corner, const Tile& tile) {
      for (int y = 0; y < kTileSide; ++y) {
        for (int x = 0; x < kTileSide; ++x) {
          const MapCell& cell = tile.at(x, y);
          if (cell.is_known()) visit(Cell{corner.x + x, corner.y + y}, cell);
        }
      }
    });
  };
  Box box;
  for_each_known([&](Cell where, const MapCell&) { box.include(where); });
  if (box.low.x > box.high.x) return {};
  const Cell corner{box.low.x - margin, box.low.y - margin};
  OccupancyGrid grid({box.high.x - box.low.x + 1 + 2 * margin,
                      box.high.y - box.low.y + 1 + 2 * margin,
                      resolution_,
                      {corner.x * resolution_, corner.y * resolution_}},
                     kUnknown);
  for_each_known([&](Cell where, const MapCell& cell) {
    grid[{where.x - corner.x, where.y - corner.y}] =
        static_cast<double>(cell.occupancy()) >= threshold ? kOccupied : kFree;
  });
  return grid;
}

}  // namespace coop::slam
