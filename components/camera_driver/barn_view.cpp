#include "camera_driver/barn_view.hpp"

#include <algorithm>
#include <cmath>

#include "core/world/shapes.hpp"

namespace coop::camera_driver {
namespace {

constexpr int kBlock = 8;                  ///< px
constexpr Colour kBoards{124, 104, 82};    ///< weathered wood of walls and nest boxes
constexpr Colour kBackground{70, 74, 78};  ///< beyond everything
constexpr double kBoardWidth = 0.12;       ///< m

/// Well mixed bits of two numbers and a seed.
std::uint32_t hash(std::int64_t a, std::int64_t b, std::uint64_t seed) {
  std::uint64_t h = seed ^ (static_cast<std::uint64_t>(a) * 0x9E3779B97F4A7C15ULL) ^
                    (static_cast<std::uint64_t>(b) * 0xC2B2AE3D27D4EB4FULL);
  h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9ULL;
  return static_cast<std::uint32_t>(h >> 32);
}

Colour shade(const Colour& colour, double brightness) {
  Colour result{};
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = static_cast<std::uint8_t>(std::clamp(colour[i] * brightness, 0.0, 255.0));
  }
  return result;
}

void put(cv::Mat& picture, int column, int row, const Colour& colour) {
  std::copy(colour.begin(), colour.end(), picture.ptr(row, column));
}

/// Colour of a block's face at a point: upright boards, each a little different.
Colour board(const Eigen::Vector3d& point, bool vertical_face, std::uint64_t seed) {
  const bool is_top = point.z() > world::kObstacleHeight - 1e-6;
  const double along = vertical_face || is_top ? point.y() : point.x();
  const double boards = along / kBoardWidth;
  const auto number = static_cast<std::int64_t>(std::floor(boards));
  const double seam = std::abs(boards - std::floor(boards) - 0.5) > 0.46 ? 0.7 : 1.0;
  const double wood = 0.88 + 0.24 * (hash(number, vertical_face ? 1 : 0, seed) % 256) / 256.0;
  const double face = is_top ? 1.12 : vertical_face ? 0.95 : 0.82;
  const double dirt = point.z() < 0.15 ? 0.75 + 0.25 * point.z() / 0.15 : 1.0;
  return shade(kBoards, wood * seam * face * dirt);
}

std::vector<int> sum_occupied(const world::RayCaster& walls) {
  const GridGeometry& geometry = walls.geometry();
  const auto stride = static_cast<std::size_t>(geometry.width) + 1;
  std::vector<int> sums(stride * (static_cast<std::size_t>(geometry.height) + 1), 0);
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
      sums[at + stride + 1] =
          sums[at + stride] + sums[at + 1] - sums[at] + (walls.occupied({x, y}) ? 1 : 0);
    }
  }
  return sums;
}

}  // namespace

BarnView::BarnView(const PixelRays& rays, const OccupancyGrid& grid, std::uint64_t seed)
    : rays_(rays), walls_(grid), litter_(seed), seed_(seed), occupied_below_(sum_occupied(walls_)) {
  const Intrinsics& camera = rays.intrinsics();
  const Eigen::Vector2d at = rays.camera().head<2>();
  floor_level_.resize(rays.size());
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const PixelRay& ray = rays.at(column, row);
      // A pixel covers size across, and size over the sine of the ray's slope along the floor.
      const double size = static_cast<double>(ray.leave) / camera.fx;
      const double slope = std::abs(static_cast<double>(ray.direction.z() / ray.direction.norm()));
      floor_level_[rays.index(column, row)] =
          static_cast<std::uint8_t>(Litter::level_of(size / std::sqrt(std::max(slope, 0.01))));
    }
  }
  for (int row = 0; row < camera.height; row += kBlock) {
    for (int column = 0; column < camera.width; column += kBlock) {
      Block block{{column, row, std::min(column + kBlock, camera.width),
                   std::min(row + kBlock, camera.height)},
                  true,
                  {}};
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const PixelRay& ray = rays.at(corner % 2 == 0 ? column : block.pixels.column_end - 1,
                                      corner / 2 == 0 ? row : block.pixels.row_end - 1);
        const Eigen::Vector2d along = ray.direction.head<2>().cast<double>();
        block.floor_only = block.floor_only && ray.meets_floor;
        block.reach[2 * corner] = at + static_cast<double>(ray.enter) * along;
        block.reach[2 * corner + 1] = at + static_cast<double>(ray.leave) * along;
      }
      blocks_.push_back(block);
    }
  }
}

bool BarnView::may_meet_obstacle(const Block& block, const Pose2& robot_in_world) const {
  // Rays of the block lie between those of its corners, and so do their ends in a plane.
  Eigen::AlignedBox2d reach;
  for (const Eigen::Vector2d& point : block.reach) reach.extend(robot_in_world * point);
  const GridGeometry& geometry = walls_.geometry();
  const Cell low = geometry.cell_of(reach.min());
  const Cell high = geometry.cell_of(reach.max());
  const auto corner = [&](int x, int y) {
    return occupied_below_[static_cast<std::size_t>(std::clamp(y, 0, geometry.height)) *
                               (static_cast<std::size_t>(geometry.width) + 1) +
                           static_cast<std::size_t>(std::clamp(x, 0, geometry.width))];
  };
  // One cell more on each side for rays that are rounded.
  return corner(high.x + 2, high.y + 2) - corner(low.x - 1, high.y + 2) -
             corner(high.x + 2, low.y - 1) + corner(low.x - 1, low.y - 1) >
         0;
}

void BarnView::draw(const Pose2& robot_in_world, cv::Mat& colour, std::vector<float>& depth) const {
  const double c = std::cos(robot_in_world.yaw);
  const double s = std::sin(robot_in_world.yaw);
  const Eigen::Vector3d camera = to_pose3(robot_in_world) * rays_.camera();
  for (const Block& block : blocks_) {
    const bool must_cast = !block.floor_only || may_meet_obstacle(block, robot_in_world);
    for (int row = block.pixels.row; row < block.pixels.row_end; ++row) {
      for (int column = block.pixels.column; column < block.pixels.column_end; ++column) {
        const std::size_t at = rays_.index(column, row);
        const PixelRay& ray = rays_.at(column, row);
        const Eigen::Vector3d in_base = ray.direction.cast<double>();
        const Eigen::Vector3d along(c * in_base.x() - s * in_base.y(),
                                    s * in_base.x() + c * in_base.y(), in_base.z());
        const double enter = static_cast<double>(ray.enter);
        const double leave = static_cast<double>(ray.leave);
        const double level = static_cast<double>(ray.level_length);
        if (must_cast && level > 1e-6) {
          const auto hit = walls_.cast(camera.head<2>() + enter * along.head<2>(),
                                       along.head<2>() / level, (leave - enter) * level);
          if (hit) {
            const double z = enter + hit->range / level;
            depth[at] = static_cast<float>(z);
            put(colour, column, row, board(camera + z * along, hit->vertical_face, seed_));
            continue;
          }
        }
        depth[at] = ray.meets_floor ? ray.leave : 0.0F;
        put(colour, column, row,
            ray.meets_floor ? litter_.at(camera.x() + leave * along.x(),
                                         camera.y() + leave * along.y(), floor_level_[at])
                            : kBackground);
      }
    }
  }
}

}  // namespace coop::camera_driver
