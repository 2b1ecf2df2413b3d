#include "core/costmap/obstacle_layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace coop {
namespace {

/// Whole cells from `from` to `to`, or false where the two grids do not share their cells' borders.
bool offset_in_cells(const GridGeometry& from, const GridGeometry& to, Cell& offset) {
  if (from.resolution != to.resolution || from.size() == 0) return false;
  const Eigen::Vector2d cells = (to.origin - from.origin) / to.resolution;
  const Eigen::Vector2d rounded = cells.array().round();
  if ((cells - rounded).cwiseAbs().maxCoeff() > 1e-3) return false;
  offset = {static_cast<int>(rounded.x()), static_cast<int>(rounded.y())};
  return true;
}

}  // namespace

void ObstacleLayerConfig::describe(config::Fields& fields) {
  fields.number("obstacle_range", obstacle_range,
                {.unit = "m", .help = "hits farther away are not marked", .min = 0.1, .max = 100});
  fields.number("clearing_range", clearing_range,
                {.unit = "m", .help = "beams clear no farther than this", .min = 0.1, .max = 100});
  fields.number("hold_time", hold_time,
                {.unit = "s",
                 .help = "a fresh mark withstands clearing beams that graze its cell",
                 .min = 0,
                 .max = 10});
  fields.number("persistence", persistence,
                {.unit = "s",
                 .help = "a mark not seen again for so long expires; 0: never",
                 .min = 0,
                 .max = 3600});
}

ObstacleLayer::ObstacleLayer(const ObstacleLayerConfig& config) : config_(config) {}

void ObstacleLayer::set_geometry(const GridGeometry& geometry) {
  if (geometry == states_.geometry) return;
  Grid<State> states(geometry, State::kUnseen);
  std::vector<std::int32_t> marked_at(geometry.size(), 0);
  Cell offset;
  if (offset_in_cells(states_.geometry, geometry, offset)) {
    const int first_x = std::max(0, -offset.x);
    const int last_x = std::min(geometry.width, states_.geometry.width - offset.x);
    for (int y = 0; y < geometry.height && first_x < last_x; ++y) {
      const Cell old{first_x + offset.x, y + offset.y};
      if (!states_.geometry.contains(old)) continue;
      const auto source = static_cast<std::ptrdiff_t>(states_.geometry.index(old));
      const auto target = static_cast<std::ptrdiff_t>(geometry.index({first_x, y}));
      std::copy_n(states_.cells.begin() + source, last_x - first_x, states.cells.begin() + target);
      std::copy_n(marked_at_.begin() + source, last_x - first_x, marked_at.begin() + target);
    }
  }
  states_ = std::move(states);
  marked_at_ = std::move(marked_at);
  rebuild_tiles();
}

void ObstacleLayer::rebuild_tiles() {
  const GridGeometry& geometry = states_.geometry;
  tiles_in_row_ = (geometry.width + kTileSide - 1) / kTileSide;
  const int rows = (geometry.height + kTileSide - 1) / kTileSide;
  const std::size_t count =
      static_cast<std::size_t>(tiles_in_row_) * static_cast<std::size_t>(rows);
  tile_changed_.assign(count, 1);
  tile_marked_.assign(count, 1);
}

CellWindow ObstacleLayer::window_of(std::size_t tile) const {
  const int x = static_cast<int>(tile) % tiles_in_row_ * kTileSide;
  const int y = static_cast<int>(tile) / tiles_in_row_ * kTileSide;
  return {{x, y},
          {std::min(x + kTileSide, states_.geometry.width),
           std::min(y + kTileSide, states_.geometry.height)}};
}

void ObstacleLayer::take_changes(std::vector<CellWindow>& changed) {
  changed.clear();
  for (std::size_t tile = 0; tile < tile_changed_.size(); ++tile) {
    if (tile_changed_[tile] == 0) continue;
    tile_changed_[tile] = 0;
    changed.push_back(window_of(tile));
  }
}

void ObstacleLayer::clear() {
  std::fill(states_.cells.begin(), states_.cells.end(), State::kUnseen);
  rebuild_tiles();
}

std::int32_t ObstacleLayer::milliseconds(Time stamp) {
  if (epoch_ == Time{} || stamp < epoch_) {  // first use, or time was set back
    epoch_ = stamp - std::chrono::hours(1);
    std::fill(marked_at_.begin(), marked_at_.end(), 0);
  }
  return static_cast<std::int32_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(stamp - epoch_).count());
}

void ObstacleLayer::integrate(const LaserScan& scan, const ScanPose& pose,
                              const Footprint& footprint) {
  const std::int32_t now = milliseconds(scan.stamp);
  clear_before_ = now - static_cast<std::int32_t>(1000.0 * config_.hold_time);
  collect_beams(scan, pose, footprint);
  for (const Beam& beam : beams_) clear_ray(beam);
  for (const Beam& beam : beams_) {
    if (!beam.marks || !states_.geometry.contains(beam.to)) continue;
    const std::size_t index = states_.geometry.index(beam.to);
    const std::size_t tile = tile_of(beam.to);
    if (states_.cells[index] != State::kMarked) tile_changed_[tile] = 1;
    tile_marked_[tile] = 1;
    states_.cells[index] = State::kMarked;
    marked_at_[index] = now;
  }
}

void ObstacleLayer::collect_beams(const LaserScan& scan, const ScanPose& pose,
                                  const Footprint& footprint) {
  beams_.clear();
  beams_.reserve(scan.ranges.size());
  const double last = scan.ranges.size() > 1 ? static_cast<double>(scan.ranges.size() - 1) : 1.0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const float measured = scan.ranges[i];
    if (std::isnan(measured) || measured < scan.range_min) continue;
    const double range = measured > scan.range_max ? scan.range_max : measured;
    const bool marks = scan.is_hit(i) && range <= config_.obstacle_range;
    const double length = std::min(range, marks ? range : config_.clearing_range);
    const double angle = scan.angle(i);
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    if (footprint.contains(pose.laser_in_base * Eigen::Vector2d(length * direction))) continue;
    // A hit lies on the obstacle's face, often on the border of two cells; the cell behind it is
    // the obstacle's.
    const double depth = marks ? 0.5 * states_.geometry.resolution : 0.0;
    const Eigen::Vector2d end_in_base =
        pose.laser_in_base * Eigen::Vector2d((length + depth) * direction);
    const Pose2 base =
        interpolate(pose.base_in_grid_first, pose.base_in_grid_last, static_cast<double>(i) / last);
    beams_.push_back({states_.geometry.cell_of(base * pose.laser_in_base.position()),
                      states_.geometry.cell_of(base * end_in_base), marks});
  }
}

/// The cells from the sensor up to, not including, the one the beam ends in: one cell a step along
/// the longer axis (Bresenham 1965, in fixed point).
void ObstacleLayer::clear_ray(const Beam& beam) {
  const int dx = beam.to.x - beam.from.x;
  const int dy = beam.to.y - beam.from.y;
  const int steps = std::max(std::abs(dx), std::abs(dy));
  if (steps == 0) return;
  constexpr std::int64_t kOne = 1 << 16;
  const std::int64_t step_x = dx * kOne / steps;
  const std::int64_t step_y = dy * kOne / steps;
  std::int64_t x = beam.from.x * kOne + kOne / 2;
  std::int64_t y = beam.from.y * kOne + kOne / 2;
  for (int i = 0; i < steps; ++i, x += step_x, y += step_y) {
    const Cell cell{static_cast<int>(x >> 16), static_cast<int>(y >> 16)};
    if (!states_.geometry.contains(cell)) continue;
    const std::size_t index = states_.geometry.index(cell);
    if (states_.cells[index] == State::kClear) continue;
    if (states_.cells[index] == State::kMarked && marked_at_[index] > clear_before_) continue;
    states_.cells[index] = State::kClear;
    tile_changed_[tile_of(cell)] = 1;
  }
}

void ObstacleLayer::expire(Time now) {
  if (config_.persistence <= 0.0) return;
  const std::int32_t oldest =
      milliseconds(now) - static_cast<std::int32_t>(1000.0 * config_.persistence);
  for (std::size_t tile = 0; tile < tile_marked_.size(); ++tile) {
    if (tile_marked_[tile] == 0) continue;
    tile_marked_[tile] = 0;
    const CellWindow window = window_of(tile);
    for (int y = window.low.y; y < window.high.y; ++y) {
      for (int x = window.low.x; x < window.high.x; ++x) {
        const std::size_t index = states_.geometry.index({x, y});
        if (states_.cells[index] != State::kMarked) continue;
        if (marked_at_[index] < oldest) {
          states_.cells[index] = State::kUnseen;
          tile_changed_[tile] = 1;
        } else {
          tile_marked_[tile] = 1;
        }
      }
    }
  }
}

std::optional<ObstacleLayer::ScanPose> scan_pose(const TransformBuffer& transforms,
                                                 std::string_view grid_frame, const LaserScan& scan,
                                                 const Pose3& base_in_grid) {
  const auto laser = transforms.lookup("base_link", scan.frame_id, scan.stamp);
  if (!laser) return std::nullopt;
  const auto last = transforms.lookup(grid_frame, "base_link", scan.stamp + scan.sweep_duration());
  const Pose2 first = to_pose2(base_in_grid);
  return ObstacleLayer::ScanPose{first, last ? to_pose2(*last) : first, to_pose2(*laser)};
}

}  // namespace coop
