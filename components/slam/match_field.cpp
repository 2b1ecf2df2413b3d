#include "slam/match_field.hpp"

#include <algorithm>
#include <cmath>

namespace coop::slam {
namespace {

constexpr int kTableSize = 1024;

}  // namespace

void MatchFieldConfig::describe(config::Fields& fields) {
  fields.number(
      "sigma", sigma,
      {.unit = "m", .help = "deviation of a beam's end from the wall", .min = 0.005, .max = 1.0});
  fields.number("outlier_share", outlier_share,
                {.help = "share of the beams that end anywhere", .min = 1e-6, .max = 0.9});
  fields.number("reach", reach,
                {.unit = "m",
                 .help = "farther from a wall a beam's end is an outlier",
                 .min = 0.01,
                 .max = 3.0});
  fields.number("occupied_threshold", occupied_threshold,
                {.help = "share of hits from which a cell is a wall", .min = 0.01, .max = 1.0});
}

MatchField::MatchField(const MatchFieldConfig& config)
    : config_(config), outlier_(static_cast<float>(std::log(config.outlier_share))) {}

void MatchField::build(const TileMap& map, Cell low, Cell high) {
  const double resolution = map.resolution();
  const double reach = config_.reach / resolution;
  radius_ = static_cast<int>(std::ceil(reach));
  reach_squared_ = static_cast<float>(reach * reach);
  width_ = high.x - low.x + 1;
  height_ = high.y - low.y + 1;
  origin_x_ = static_cast<float>(low.x) + 0.5F;
  origin_y_ = static_cast<float>(low.y) + 0.5F;
  limit_x_ = static_cast<float>(width_ - 1);
  limit_y_ = static_cast<float>(height_ - 1);
  values_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                 reach_squared_);
  wall_cells_ = 0;
  const auto threshold = static_cast<float>(config_.occupied_threshold);
  const auto scale = static_cast<float>(1.0 / resolution);
  for (int tile_y = low.y & ~(kTileSide - 1); tile_y <= high.y; tile_y += kTileSide) {
    for (int tile_x = low.x & ~(kTileSide - 1); tile_x <= high.x; tile_x += kTileSide) {
      const Tile* tile = map.tile_at({tile_x, tile_y});
      if (!tile) continue;
      for (int y = 0; y < kTileSide; ++y) {
        for (int x = 0; x < kTileSide; ++x) {
          const MapCell& cell = tile->at(x, y);
          if (cell.hits == 0 || cell.occupancy() < threshold) continue;
          stamp(static_cast<float>(tile_x + x - low.x) + cell.mean_x * scale,
                static_cast<float>(tile_y + y - low.y) + cell.mean_y * scale);
        }
      }
    }
  }
  const double s = config_.sigma / resolution;
  table_.resize(kTableSize + 1);
  for (int i = 0; i <= kTableSize; ++i) {
    const double d2 = reach * reach * i / kTableSize;
    table_[static_cast<std::size_t>(i)] = static_cast<float>(std::log(
        (1.0 - config_.outlier_share) * std::exp(-d2 / (2.0 * s * s)) + config_.outlier_share));
  }
  outlier_ = table_.back();
  const float to_table = static_cast<float>(kTableSize) / reach_squared_;
  for (float& value : values_) {
    value = value < reach_squared_ ? table_[static_cast<std::size_t>(value * to_table)] : outlier_;
  }
}

void MatchField::stamp(float x, float y) {
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  const int left = std::max(column - radius_, 0);
  const int right = std::min(column + radius_, width_ - 1);
  const int bottom = std::max(row - radius_, 0);
  const int top = std::min(row + radius_, height_ - 1);
  if (left > right || bottom > top) return;
  ++wall_cells_;
  for (int r = bottom; r <= top; ++r) {
    const float dy = static_cast<float>(r) + 0.5F - y;
    float* line = values_.data() + static_cast<std::size_t>(r * width_);
    for (int c = left; c <= right; ++c) {
      const float dx = static_cast<float>(c) + 0.5F - x;
      line[c] = std::min(line[c], dx * dx + dy * dy);
    }
  }
}

}  // namespace coop::slam
