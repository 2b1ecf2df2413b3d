#pragma once
#include <vector>

#include "camera_driver/frame.hpp"
#include "camera_driver/litter.hpp"
#include "camera_driver/pixel_rays.hpp"
#include "core/world/ray_caster.hpp"

namespace coop::camera_driver {

/// What never moves: floor, walls and the like, which are occupied cells of a grid as blocks of
/// world::kObstacleHeight. Draws colour and exact depth of every pixel.
///
/// Most of a picture is floor with nothing near. Blocks of 8 x 8 pixels whose rays stay over free
/// cells, which a table of sums tells in four look-ups, are drawn without casting a ray.
class BarnView {
 public:
  BarnView(const PixelRays& rays, const OccupancyGrid& grid, std::uint64_t seed);

  /// Every pixel is written. `depth`: m along the optical axis, 0 where there is nothing.
  void draw(const Pose2& robot_in_world, cv::Mat& colour, std::vector<float>& depth) const;

 private:
  struct Block {
    PixelBlock pixels;
    bool floor_only = false;  ///< all corners' rays meet the floor, so `reach` is known
    /// Over the floor, in base_link: where the corners' rays come below obstacles, and end.
    std::array<Eigen::Vector2d, 8> reach;
  };
  [[nodiscard]] bool may_meet_obstacle(const Block& block, const Pose2& robot_in_world) const;

  const PixelRays& rays_;
  world::RayCaster walls_;
  Litter litter_;
  std::uint64_t seed_;
  std::vector<std::uint8_t> floor_level_;  ///< of the litter, for each pixel
  std::vector<Block> blocks_;
  std::vector<int> occupied_below_;  ///< occupied cells left of and below each corner of cells
};

}  // namespace coop::camera_driver
