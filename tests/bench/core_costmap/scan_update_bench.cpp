#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/costmap/obstacle_layer.hpp"
#include "support/warehouse.hpp"

namespace coop {
namespace {

/// A robot that stands in the warehouse, a laser of 360 beams, and a box of 0.3 m that is there in
/// every second scan.
class ScannedWarehouse {
 public:
  explicit ScannedWarehouse(const Costmap& map)
      : map_(map), layer_({.hold_time = 0.0}), costmap_({}, 0.28) {
    layer_.set_geometry(map.geometry());
    costmap_.reset(map.geometry());
    std::copy(map.obstacles().begin(), map.obstacles().end(), costmap_.obstacles().begin());
    costmap_.update();
    robot_ = map.geometry().center_of(free_place());
    for (const bool box : {false, true}) scans_[box ? 1 : 0] = measure(box);
  }

  /// Raytrace, expiry, composition of static map and marks where these changed, costs.
  void update() {
    ++count_;
    LaserScan& scan = scans_[count_ % 2];
    scan.stamp = time_from_seconds(1000.0 + 0.1 * static_cast<double>(count_));
    const Pose2 base{robot_.x(), robot_.y(), 0.0};
    layer_.integrate(scan, {base, base, {}}, footprint_);
    layer_.expire(scan.stamp);
    layer_.take_changes(windows_);
    changed_.clear();
    for (const CellWindow& window : windows_) compose(window);
    costmap_.update(changed_);
  }
  [[nodiscard]] const Costmap& costmap() const { return costmap_; }
  [[nodiscard]] std::size_t changed() const { return changed_.size(); }

 private:
  [[nodiscard]] Cell free_place() const {
    const GridGeometry& grid = map_.geometry();
    Cell cell{grid.width / 2, grid.height / 2};
    while (map_.cost_at(cell) != kFreeCost) ++cell.y;
    return cell;
  }

  [[nodiscard]] LaserScan measure(bool box) const {
    LaserScan scan;
    scan.angle_increment = static_cast<float>(2.0 * std::numbers::pi / 360.0);
    scan.range_min = 0.1F;
    scan.range_max = 12.0F;
    const GridGeometry& grid = map_.geometry();
    for (std::size_t i = 0; i < 360; ++i) {
      const double angle = scan.angle(i);
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      double range = 0.5;
      for (; range < 11.9; range += 0.25 * grid.resolution) {
        const Eigen::Vector2d at = robot_ + range * direction;
        const Cell cell = grid.cell_of(at);
        if (!grid.contains(cell) || map_.obstacles()[grid.index(cell)] != 0) break;
        const Eigen::Vector2d in_box = at - robot_ - Eigen::Vector2d(2.0, 0.4);
        if (box && in_box.cwiseAbs().maxCoeff() < 0.15) break;
      }
      scan.ranges.push_back(static_cast<float>(range));
    }
    return scan;
  }

  void compose(const CellWindow& window) {
    const GridGeometry& grid = map_.geometry();
    for (int y = window.low.y; y < window.high.y; ++y) {
      for (int x = window.low.x; x < window.high.x; ++x) {
        const std::size_t i = grid.index({x, y});
        // What is seen within 0.1 m of an obstacle of the map is that obstacle.
        const bool seen = layer_.states()[i] == ObstacleLayer::State::kMarked &&
                          map_.distances().squared_cells()[i] > 11;
        const std::uint8_t obstacle = map_.obstacles()[i] != 0 || seen ? 1 : 0;
        if (costmap_.obstacles()[i] == obstacle) continue;
        costmap_.obstacles()[i] = obstacle;
        changed_.push_back({{x, y}, {x + 1, y + 1}});
      }
    }
  }

  const Costmap& map_;
  ObstacleLayer layer_;
  Costmap costmap_;
  Eigen::Vector2d robot_{0, 0};
  Footprint footprint_{{{-0.18, -0.28}, {0.77, -0.28}, {0.77, 0.28}, {-0.18, 0.28}}};
  LaserScan scans_[2];
  std::size_t count_ = 0;
  std::vector<CellWindow> windows_;
  std::vector<CellWindow> changed_;
};

void BM_CostmapUpdateByAScan(benchmark::State& state) {
  const Costmap* map = test::warehouse();
  if (map == nullptr) {
    state.SkipWithError("not run: shared map is absent");
    return;
  }
  ScannedWarehouse warehouse(*map);
  warehouse.update();  // the first scan clears all it sees
  warehouse.update();
  std::size_t changed = 0;
  for (auto _ : state) {
    warehouse.update();
    benchmark::DoNotOptimize(warehouse.costmap().costs().cells.data());
    changed += warehouse.changed();
  }
  state.counters["obstacle_cells_changed"] =
      static_cast<double>(changed) / static_cast<double>(state.iterations());
}
BENCHMARK(BM_CostmapUpdateByAScan)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace coop
