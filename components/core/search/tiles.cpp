#include "core/search/tiles.hpp"

#include <algorithm>

namespace coop::search {

bool Tiles::update(const TraversalGrid& grid) {
  if (revision_ == grid.revision()) return false;
  revision_ = grid.revision();
  const auto width = static_cast<std::uint32_t>(grid.geometry().width + 2);
  const auto height = static_cast<std::uint32_t>(grid.geometry().height + 2);
  row_of_tiles_ = (width + kSide - 1) / kSide * kTile;
  cells_.assign(static_cast<std::size_t>(row_of_tiles_) * ((height + kSide - 1) / kSide),
                kLethalCost);
  const Cost* from = grid.cells().data();
  for (std::uint32_t y = 0; y < height; ++y, from += width) {
    Cost* to = &cells_[(y / kSide) * row_of_tiles_ + (y % kSide) * kSide];
    for (std::uint32_t x = 0; x < width; x += kSide, to += kTile) {
      std::copy_n(from + x, std::min(kSide, width - x), to);
    }
  }
  first_cells_.clear();
  for (std::uint32_t tile = 0; tile < cells_.size() / kTile; ++tile) {
    const std::uint32_t tiles_in_row = row_of_tiles_ / kTile;
    first_cells_.push_back({static_cast<int>(tile % tiles_in_row * kSide) - 1,
                            static_cast<int>(tile / tiles_in_row * kSide) - 1});
  }
  return true;
}

}  // namespace coop::search
