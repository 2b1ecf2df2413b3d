#include "slam/map_updater.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace coop::slam {
namespace {

constexpr std::uint8_t kPassed = 1;
constexpr std::uint8_t kHit = 2;

void transform(const std::vector<Eigen::Vector2f>& points, const Pose2& base_in_map,
               std::vector<Eigen::Vector2d>& out) {
  const double c = std::cos(base_in_map.yaw);
  const double s = std::sin(base_in_map.yaw);
  out.resize(points.size());
  std::ranges::transform(points, out.begin(), [&](const Eigen::Vector2f& point) {
    const Eigen::Vector2d p = point.cast<double>();
    return Eigen::Vector2d(base_in_map.x + c * p.x() - s * p.y(),
                           base_in_map.y + s * p.x() + c * p.y());
  });
}

}  // namespace

void MapUpdater::integrate(TileMap& map, const ScanPoints& points, const Pose2& base_in_map) {
  const Cell laser = map.cell_of(base_in_map * points.laser_in_base);
  place_window(map, laser, points, base_in_map);
  for (const auto& end : ends_in_map_) mark_line(laser, map.cell_of(end));
  for (const auto& end : open_ends_in_map_) mark_line(laser, map.cell_of(end));
  for (const auto& end : ends_in_map_) marks_[index(map.cell_of(end))] = kHit;
  apply_passes(map);
  apply_hits(map);
}

void MapUpdater::place_window(const TileMap& map, Cell laser, const ScanPoints& points,
                              const Pose2& base_in_map) {
  transform(points.ends, base_in_map, ends_in_map_);
  transform(points.open_ends, base_in_map, open_ends_in_map_);
  Cell low = laser;
  Cell high = laser;
  const auto include = [&](const Eigen::Vector2d& end) {
    const Cell cell = map.cell_of(end);
    low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
    high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
  };
  std::ranges::for_each(ends_in_map_, include);
  std::ranges::for_each(open_ends_in_map_, include);
  low_ = {low.x & ~(kTileSide - 1), low.y & ~(kTileSide - 1)};
  width_ = (high.x | (kTileSide - 1)) + 1 - low_.x;
  height_ = (high.y | (kTileSide - 1)) + 1 - low_.y;
  marks_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
}

/// Bresenham's line without its last cell.
void MapUpdater::mark_line(Cell from, Cell to) {
  const int dx = std::abs(to.x - from.x);
  const int dy = -std::abs(to.y - from.y);
  const std::ptrdiff_t step_x = to.x > from.x ? 1 : -1;
  const std::ptrdiff_t step_y = to.y > from.y ? width_ : -width_;
  int error = dx + dy;
  std::uint8_t* mark = marks_.data() + index(from);
  const std::uint8_t* last = marks_.data() + index(to);
  while (mark != last) {
    *mark = kPassed;
    const int twice = 2 * error;
    if (twice >= dy) {
      error += dy;
      mark += step_x;
    }
    if (twice <= dx) {
      error += dx;
      mark += step_y;
    }
  }
}

void MapUpdater::apply_passes(TileMap& map) const {
  for (int tile_y = 0; tile_y < height_; tile_y += kTileSide) {
    for (int tile_x = 0; tile_x < width_; tile_x += kTileSide) {
      Tile* tile = nullptr;
      for (int y = 0; y < kTileSide; ++y) {
        const std::uint8_t* row =
            marks_.data() +
            static_cast<std::size_t>(tile_y + y) * static_cast<std::size_t>(width_) +
            static_cast<std::size_t>(tile_x);
        if (std::memchr(row, kPassed, kTileSide) == nullptr) continue;
        if (!tile) tile = &map.writable_tile_at({low_.x + tile_x, low_.y + tile_y});
        for (int x = 0; x < kTileSide; ++x) {
          if (row[x] == kPassed) tile->at(x, y).add_pass();
        }
      }
    }
  }
}

void MapUpdater::apply_hits(TileMap& map) const {
  const double resolution = map.resolution();
  for (const auto& end : ends_in_map_) {
    const Cell cell = map.cell_of(end);
    map.writable_tile_at(cell)
        .at(cell.x, cell.y)
        .add_hit(static_cast<float>(end.x() - cell.x * resolution),
                 static_cast<float>(end.y() - cell.y * resolution));
  }
}

}  // namespace coop::slam
