#include "camera_driver/simulated_camera.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string>

#include "core/config/error.hpp"
#include "core/world/shapes.hpp"

namespace coop::camera_driver {
namespace {

constexpr Colour kFeathers{98, 66, 40};
constexpr Colour kYolk{214, 156, 40};
constexpr double kPuddleRadius = 0.045;  ///< m, of a broken egg
constexpr double kPuddleHeight = 0.003;  ///< m
constexpr double kAmbient = 0.62;        ///< share of light that comes from everywhere

/// Shells go from white over cream to a pale green, fixed by the egg's name.
Colour shell(const std::string& id) {
  constexpr std::array<Colour, 4> kShells{
      {{240, 238, 230}, {238, 230, 208}, {226, 230, 208}, {214, 226, 208}}};
  const double turn = world::egg_heading(id + "/shell") / std::numbers::pi;  // in [0, 1)
  return kShells[static_cast<std::size_t>(turn * static_cast<double>(kShells.size()))];
}

/// Lamps under the ceiling: light from above.
void paint(const Colour& colour, const Eigen::Vector3d& normal, std::uint8_t* pixel) {
  const double light = kAmbient + (1.0 - kAmbient) * std::max(0.0, normal.z());
  for (std::size_t i = 0; i < 3; ++i) pixel[i] = static_cast<std::uint8_t>(colour[i] * light);
}

}  // namespace

void SimulatedCameraConfig::describe(config::Fields& fields) {
  fields.integer("width", width, {.unit = "px", .help = "columns", .min = 64, .max = 1920});
  fields.integer("height", height, {.unit = "px", .help = "rows", .min = 48, .max = 1080});
  fields.number("range_min", range_min,
                {.unit = "m", .help = "nearest depth", .min = 0, .max = 10});
  fields.number("range_max", range_max,
                {.unit = "m", .help = "farthest depth", .min = 0.1, .max = 60});
  fields.section("noise", noise);
}

void SimulatedCameraConfig::validate() const {
  if (range_min >= range_max) throw config::Error("range_min: expected less than range_max");
}

SimulatedCamera::SimulatedCamera(const SimulatedCameraConfig& config, const world::World& world,
                                 const Pose3& camera_in_base, std::uint64_t seed)
    : rays_(d435i_intrinsics(config.width, config.height), camera_in_base, world::kObstacleHeight,
            config.range_max),
      barn_(rays_, world.grid, seed),
      noise_(config.noise, config.range_min, config.range_max, seed),
      depth_(rays_.size()) {}

void SimulatedCamera::draw_egg(const world::Egg& egg, const Pose2& world_in_robot,
                               cv::Mat& colour) {
  EggShape shape;
  shape.center << world_in_robot * Eigen::Vector2d(egg.position.head<2>()), egg.position.z();
  shape.heading = world::egg_heading(egg.id) + world_in_robot.yaw;
  const EggSurface surface(shape, rays_.camera());
  const Colour paint_of_shell = shell(egg.id);
  const PixelBlock block = rays_.cover(shape.bounds());
  for (int row = block.row; row < block.row_end; ++row) {
    for (int column = block.column; column < block.column_end; ++column) {
      const auto hit = surface.cast(rays_.at(column, row).direction.cast<double>());
      float& depth = depth_[rays_.index(column, row)];
      if (!hit || (depth > 0.0F && static_cast<float>(hit->depth) >= depth)) continue;
      depth = static_cast<float>(hit->depth);
      paint(paint_of_shell, hit->normal, colour.ptr(row, column));
    }
  }
}

void SimulatedCamera::draw_cylinder(const Cylinder& in_base, const Colour& colour_of_it,
                                    cv::Mat& colour) {
  const PixelBlock block = rays_.cover(in_base.bounds());
  for (int row = block.row; row < block.row_end; ++row) {
    for (int column = block.column; column < block.column_end; ++column) {
      const auto hit = in_base.cast(rays_.camera(), rays_.at(column, row).direction.cast<double>());
      float& depth = depth_[rays_.index(column, row)];
      if (!hit || (depth > 0.0F && static_cast<float>(hit->depth) >= depth)) continue;
      depth = static_cast<float>(hit->depth);
      paint(colour_of_it, hit->normal, colour.ptr(row, column));
    }
  }
}

void SimulatedCamera::take(const world::GroundTruth& truth, Frame& frame) {
  const Intrinsics& camera = rays_.intrinsics();
  frame.stamp = truth.stamp;
  frame.colour.create(camera.height, camera.width, CV_8UC3);
  frame.depth.create(camera.height, camera.width, CV_16UC1);
  barn_.draw(truth.robot_in_world, frame.colour, depth_);
  const Pose2 world_in_robot = truth.robot_in_world.inverse();
  for (const world::Egg& egg : truth.eggs) {
    if (egg.state == world::EggState::kBroken) {
      draw_cylinder(
          {world_in_robot * Eigen::Vector2d(egg.position.head<2>()), kPuddleRadius, kPuddleHeight},
          kYolk, frame.colour);
    } else if (egg.state != world::EggState::kCollected) {
      draw_egg(egg, world_in_robot, frame.colour);
    }
  }
  for (const world::Animal& animal : truth.animals) {
    draw_cylinder({world_in_robot * animal.position, animal.radius, world::kAnimalHeight},
                  kFeathers, frame.colour);
  }
  noise_.apply(depth_, frame);
}

}  // namespace coop::camera_driver
