#include "camera_driver/overhead_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/random.hpp"
#include "core/world/shapes.hpp"

namespace coop::camera_driver {
namespace {

using Eigen::Vector2d;

// Red, green, blue.
const cv::Scalar kConcrete(150, 148, 142);
const cv::Scalar kWet(104, 101, 97);
const cv::Scalar kFeed(152, 118, 74);
const cv::Scalar kWallSide(118, 112, 104);
const cv::Scalar kWallTop(176, 170, 160);
const cv::Scalar kManure(72, 52, 30);
const cv::Scalar kManureTop(88, 66, 40);
const cv::Scalar kPigSide(204, 146, 136);
const cv::Scalar kPigBack(232, 178, 166);
const cv::Scalar kRobotSide(40, 78, 140);
const cv::Scalar kRobotDeck(62, 112, 190);

constexpr int kSubpixelBits = 4;
constexpr int kWetPatches = 10;
constexpr int kCrumbs = 60;

void fill(cv::Mat& picture, const std::vector<cv::Point2f>& outline, const cv::Scalar& colour) {
  std::vector<cv::Point> points;
  points.reserve(outline.size());
  for (const cv::Point2f& point : outline) {
    points.emplace_back(cvRound(point.x * (1 << kSubpixelBits)),
                        cvRound(point.y * (1 << kSubpixelBits)));
  }
  cv::fillConvexPoly(picture, points, colour, cv::LINE_8, kSubpixelBits);
}

std::vector<Vector2d> circle(const Vector2d& center, double radius) {
  constexpr int kCorners = 32;
  std::vector<Vector2d> points;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    points.emplace_back(center + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

}  // namespace

OverheadCamera::OverheadCamera(const OverheadMount& mount, const SensorNoiseConfig& noise,
                               const world::World& world, RobotBody robot, std::uint64_t seed)
    : intrinsics_(mount.intrinsics()),
      map_in_camera_(mount.camera_in_map().inverse()),
      robot_(std::move(robot)),
      noise_(noise, 0.0, 1.0, seed),
      empty_pen_(intrinsics_.height, intrinsics_.width, CV_8UC3, kConcrete) {
  draw_floor(seed);
  draw_walls(world.grid);
}

cv::Point2f OverheadCamera::project(const Vector2d& place, double height) const {
  const Eigen::Vector3d in_camera = map_in_camera_ * Eigen::Vector3d(place.x(), place.y(), height);
  const Vector2d pixel = intrinsics_.project(in_camera);
  return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
}

void OverheadCamera::draw_floor(std::uint64_t seed) {
  RandomStream random(seed, "camera/pen_floor");
  const auto patch = [&](const cv::Scalar& colour, double smallest, double largest) {
    const cv::Point2f center(static_cast<float>(random.uniform(0.0, intrinsics_.width)),
                             static_cast<float>(random.uniform(0.0, intrinsics_.height)));
    const auto length = static_cast<float>(random.uniform(smallest, largest));
    const auto width = static_cast<float>(length * random.uniform(0.5, 1.0));
    const auto angle = static_cast<float>(random.uniform(0.0, 180.0));
    cv::ellipse(empty_pen_, {center, {length, width}, angle}, colour, cv::FILLED);
  };
  for (int i = 0; i < kWetPatches; ++i) patch(kWet, 20.0, 90.0);
  cv::GaussianBlur(empty_pen_, empty_pen_, {}, 3.0);  // water has no edge
  for (int i = 0; i < kCrumbs; ++i) patch(kFeed, 2.0, 5.0);
  // Concrete is rough: a brightness of its own for every few pixels.
  cv::Mat roughness(empty_pen_.size(), CV_32FC1);
  for (auto it = roughness.begin<float>(); it != roughness.end<float>(); ++it) {
    *it = static_cast<float>(random.normal(0.0, 14.0));
  }
  cv::GaussianBlur(roughness, roughness, {}, 1.2);
  cv::Mat shade;
  cv::merge(std::vector<cv::Mat>(3, roughness), shade);
  cv::add(empty_pen_, shade, empty_pen_, cv::noArray(), CV_8U);
}

void OverheadCamera::draw_walls(const OccupancyGrid& grid) {
  // The farthest from the camera first: nearer blocks hide them.
  std::vector<std::pair<double, Vector2d>> blocks;
  const Vector2d below_camera = map_in_camera_.inverse().translation().head<2>();
  const cv::Rect2f shown({}, cv::Size2f(empty_pen_.size()));
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (!world::is_occupied(grid.cells[i])) continue;
    const Vector2d center = grid.geometry.center_of(grid.geometry.cell_at(i));
    if (!shown.contains(project(center, 0.0))) continue;
    blocks.emplace_back((center - below_camera).norm(), center);
  }
  std::ranges::sort(blocks, std::greater<>{}, [](const auto& block) { return block.first; });
  const double half = 0.5 * grid.geometry.resolution;
  for (const auto& [distance, center] : blocks) {
    draw_prism({center + Vector2d(-half, -half), center + Vector2d(half, -half),
                center + Vector2d(half, half), center + Vector2d(-half, half)},
               world::kObstacleHeight, kWallSide, kWallTop, empty_pen_);
  }
}

void OverheadCamera::draw_prism(const std::vector<Vector2d>& base, double height,
                                const cv::Scalar& side, const cv::Scalar& top,
                                cv::Mat& picture) const {
  std::vector<cv::Point2f> all;
  std::vector<cv::Point2f> upper;
  for (const Vector2d& corner : base) {
    all.push_back(project(corner, 0.0));
    upper.push_back(project(corner, height));
  }
  all.insert(all.end(), upper.begin(), upper.end());
  std::vector<cv::Point2f> silhouette;
  cv::convexHull(all, silhouette);
  fill(picture, silhouette, side);
  fill(picture, upper, top);
}

/// A heap has the outline of its name, within a tenth of its radius.
void OverheadCamera::draw_heap(const world::Heap& heap, cv::Mat& picture) const {
  RandomStream random(0, "camera/heap/" + heap.id);
  std::vector<Vector2d> base = circle(heap.position, heap.radius);
  for (Vector2d& corner : base) {
    corner = heap.position + random.uniform(0.9, 1.1) * (corner - heap.position);
  }
  std::vector<cv::Point2f> outline;
  std::vector<cv::Point2f> upper;
  for (const Vector2d& corner : base) {
    outline.push_back(project(corner, 0.0));
    upper.push_back(project(heap.position + 0.5 * (corner - heap.position), world::kHeapHeight));
  }
  std::vector<cv::Point2f> hull;
  cv::convexHull(outline, hull);
  fill(picture, hull, kManure);
  cv::convexHull(upper, hull);
  fill(picture, hull, kManureTop);
}

void OverheadCamera::draw_pig(const world::Animal& pig, cv::Mat& picture) const {
  draw_prism(circle(pig.position, pig.radius), world::kAnimalHeight, kPigSide, kPigBack, picture);
}

void OverheadCamera::draw_robot(const Pose2& robot_in_world, cv::Mat& picture) const {
  std::vector<Vector2d> base;
  for (const Vector2d& corner : robot_.footprint) base.push_back(robot_in_world * corner);
  draw_prism(base, robot_.height, kRobotSide, kRobotDeck, picture);
}

void OverheadCamera::take(const world::GroundTruth& truth, Frame& frame) {
  frame.stamp = truth.stamp;
  frame.depth.release();
  empty_pen_.copyTo(frame.colour);
  for (const world::Heap& heap : truth.heaps) {
    if (heap.state == world::HeapState::kOnFloor) draw_heap(heap, frame.colour);
  }
  draw_robot(truth.robot_in_world, frame.colour);  // lower than any pig
  const Vector2d below_camera = map_in_camera_.inverse().translation().head<2>();
  std::vector<const world::Animal*> pigs;
  for (const world::Animal& animal : truth.animals) pigs.push_back(&animal);
  std::ranges::sort(pigs, std::greater<>{}, [&](const world::Animal* pig) {
    return (pig->position - below_camera).norm();
  });
  for (const world::Animal* pig : pigs) draw_pig(*pig, frame.colour);
  noise_.apply_to_colour(frame);
}

}  // namespace coop::camera_driver
