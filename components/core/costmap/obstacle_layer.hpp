#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/config/fields.hpp"
#include "core/costmap/distance_transform.hpp"
#include "core/costmap/footprint.hpp"
#include "core/grid.hpp"
#include "core/pose.hpp"
#include "core/scan.hpp"
#include "core/time.hpp"
#include "core/transform_buffer.hpp"

namespace coop {

struct ObstacleLayerConfig {
  double obstacle_range = 6.0;  ///< m: hits farther away are not marked
  double clearing_range = 8.0;  ///< m: rays clear no farther than this
  double hold_time = 0.25;    ///< s: a fresh mark withstands clearing rays that only graze its cell
  double persistence = 30.0;  ///< s: a mark not seen again for so long expires; 0: never

  void describe(config::Fields& fields);
};

/// Obstacles as the range finder sees them: each beam clears the cells it crosses and marks the one
/// it ends in. All beams of a scan clear before any marks. Cells never looked at stay unseen.
class ObstacleLayer {
 public:
  enum class State : std::uint8_t { kUnseen, kClear, kMarked };

  explicit ObstacleLayer(const ObstacleLayerConfig& config = {});

  /// Where the layer lies. What is known of cells common to both geometries is kept where the
  /// resolution is the same and the origins differ by whole cells, else all is forgotten.
  void set_geometry(const GridGeometry& geometry);
  void clear();

  /// The robot during a scan: base_link in the grid's frame at the first and at the last beam;
  /// poses between are interpolated. `laser_in_base` is the sensor's mount.
  struct ScanPose {
    Pose2 base_in_grid_first;
    Pose2 base_in_grid_last;
    Pose2 laser_in_base;
  };
  /// Hits on the robot itself (inside `footprint`) are left out.
  void integrate(const LaserScan& scan, const ScanPose& pose, const Footprint& footprint);

  /// Lets marks older than the persistence expire: they become unseen.
  void expire(Time now);

  /// Windows that hold every cell whose state has changed since the last call (since the beginning,
  /// at the first), and others: what a costmap has to look at again.
  void take_changes(std::vector<CellWindow>& changed);

  [[nodiscard]] const GridGeometry& geometry() const { return states_.geometry; }
  [[nodiscard]] State state(Cell cell) const { return states_.at_or(cell, State::kUnseen); }
  [[nodiscard]] std::span<const State> states() const { return states_.cells; }

 private:
  struct Beam {
    Cell from;
    Cell to;
    bool marks;
  };
  void collect_beams(const LaserScan& scan, const ScanPose& pose, const Footprint& footprint);
  void clear_ray(const Beam& beam);
  [[nodiscard]] std::int32_t milliseconds(Time stamp);

  /// Square pieces of the grid, each with what is known of it as a whole.
  static constexpr int kTileSide = 16;
  [[nodiscard]] std::size_t tile_of(Cell cell) const {
    return static_cast<std::size_t>(cell.y / kTileSide * tiles_in_row_ + cell.x / kTileSide);
  }
  [[nodiscard]] CellWindow window_of(std::size_t tile) const;
  void rebuild_tiles();

  ObstacleLayerConfig config_;
  Grid<State> states_;
  std::vector<std::int32_t> marked_at_;  ///< ms since epoch_, of the last mark
  int tiles_in_row_ = 0;
  std::vector<std::uint8_t> tile_changed_;  ///< 1: a state in the tile has changed
  std::vector<std::uint8_t> tile_marked_;   ///< 1: cells of the tile may be marked
  std::vector<Beam> beams_;
  Time epoch_{};
  std::int32_t clear_before_ = 0;  ///< marks after this withstand clearing, ms
};

/// The robot during a scan whose first beam it met at `base_in_grid`, a pose in `grid_frame`. Where
/// the pose at the last beam is not known yet, that at the first stands for it; nothing where the
/// laser's mount is unknown.
[[nodiscard]] std::optional<ObstacleLayer::ScanPose> scan_pose(const TransformBuffer& transforms,
                                                               std::string_view grid_frame,
                                                               const LaserScan& scan,
                                                               const Pose3& base_in_grid);

}  // namespace coop
