#include "camera_driver/egg_detector.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/config/error.hpp"
#include "core/world/shapes.hpp"

namespace coop::camera_driver {
namespace {

/// Half an egg's size along a ray, between its half width and half length, m.
constexpr double kHalfThickness = 0.0245;
/// Area of an egg's outline, between those seen along and across its axis, m^2.
constexpr double kOutline = 1.9e-3;
/// Pixels whose depth errors are as one: neighbours share a part of the noise.
constexpr double kPixelsOfOneError = 25.0;
/// Depths farther from the median are not of the same surface, m.
constexpr double kSurfaceDepth = 0.06;

}  // namespace

void EggDetectorConfig::describe(config::Fields& fields) {
  fields.integer("min_brightness", min_brightness,
                 {.unit = "1", .help = "of the strongest channel", .min = 1, .max = 255});
  fields.number("max_saturation", max_saturation,
                {.unit = "1", .help = "1 - weakest / strongest channel", .min = 0, .max = 1});
  fields.integer("min_area", min_area,
                 {.unit = "px", .help = "smallest region", .min = 5, .max = 10000});
  fields.number("max_depth", max_depth,
                {.unit = "m", .help = "farthest egg", .min = 0.1, .max = 20});
  fields.number("min_valid_depth", min_valid_depth,
                {.unit = "1", .help = "share of pixels with depth", .min = 0, .max = 1});
  fields.number("min_width", min_width, {.unit = "m", .help = "short axis", .min = 0, .max = 1});
  fields.number("max_width", max_width, {.unit = "m", .help = "short axis", .min = 0, .max = 1});
  fields.number("min_length", min_length, {.unit = "m", .help = "long axis", .min = 0, .max = 1});
  fields.number("max_length", max_length, {.unit = "m", .help = "long axis", .min = 0, .max = 1});
  fields.number("min_fill", min_fill,
                {.unit = "1", .help = "area in the ellipse's", .min = 0, .max = 1});
  fields.number("min_height", min_height,
                {.unit = "m", .help = "centre above the floor around", .min = -1, .max = 1});
  fields.number("max_height", max_height,
                {.unit = "m", .help = "centre above the floor around", .min = -1, .max = 1});
  fields.number("floor_tolerance", floor_tolerance,
                {.unit = "m", .help = "centre off the floor plane", .min = 0, .max = 1});
  fields.number("pixel_stddev", pixel_stddev,
                {.unit = "px", .help = "deviation of a centre", .min = 0.01, .max = 100});
  fields.number("depth_bias", depth_bias,
                {.unit = "m", .help = "deviation beside noise", .min = 0, .max = 1});
  fields.section("depth_noise", depth_noise);
}

void EggDetectorConfig::validate() const {
  if (min_width >= max_width) throw config::Error("min_width: expected less than max_width");
  if (min_length >= max_length) throw config::Error("min_length: expected less than max_length");
  if (min_height >= max_height) throw config::Error("min_height: expected less than max_height");
}

EggDetector::EggDetector(const EggDetectorConfig& config, const Intrinsics& intrinsics,
                         const Pose3& camera_in_base)
    : config_(config), intrinsics_(intrinsics), camera_in_base_(camera_in_base) {}

void EggDetector::segment(const cv::Mat& colour) {
  mask_.create(colour.size(), CV_8UC1);
  const int share = static_cast<int>(256.0 * (1.0 - config_.max_saturation));
  for (int row = 0; row < colour.rows; ++row) {
    const std::uint8_t* pixel = colour.ptr(row);
    std::uint8_t* const mask = mask_.ptr(row);
    for (int column = 0; column < colour.cols; ++column, pixel += 3) {
      const int strongest = std::max({pixel[0], pixel[1], pixel[2]});
      const int weakest = std::min({pixel[0], pixel[1], pixel[2]});
      const bool shell = strongest >= config_.min_brightness && 256 * weakest >= share * strongest;
      mask[column] = shell ? 255 : 0;
    }
  }
  // A majority of 3 x 3 rounds outlines and drops single pixels of noise.
  cv::medianBlur(mask_, mask_, 3);
}

std::optional<EggDetector::SurfaceDepth> EggDetector::surface_depth(const Blob& blob,
                                                                    const cv::Mat& depth) {
  depths_.clear();
  for (int row = blob.box.y; row < blob.box.br().y; ++row) {
    const auto* const label = labels_.ptr<int>(row);
    const auto* const mm = depth.ptr<std::uint16_t>(row);
    for (int column = blob.box.x; column < blob.box.br().x; ++column) {
      if (label[column] == blob.label && mm[column] != 0) depths_.push_back(mm[column]);
    }
  }
  const auto needed = static_cast<std::size_t>(config_.min_valid_depth * blob.area) + 1;
  if (depths_.size() < needed) return std::nullopt;
  const auto middle = depths_.begin() + static_cast<std::ptrdiff_t>(depths_.size() / 2);
  std::nth_element(depths_.begin(), middle, depths_.end());
  const double median = 0.001 * *middle;
  double sum = 0.0;
  SurfaceDepth surface;
  for (const std::uint16_t mm : depths_) {
    const double z = 0.001 * mm;
    if (std::abs(z - median) > kSurfaceDepth) continue;
    sum += z;
    ++surface.pixels;
  }
  surface.mean = sum / surface.pixels;
  return surface;
}

double EggDetector::height_of(const Eigen::Vector3d& point) const {
  return camera_in_base_.translation().z() + camera_in_base_.linear().row(2).dot(point);
}

double EggDetector::floor_around(const Blob& blob, const cv::Mat& depth) {
  constexpr std::size_t kEnough = 12;
  constexpr int kEdge = 1;  // px around the blob that may still show the egg
  const cv::Rect inner(blob.box.x - kEdge, blob.box.y - kEdge, blob.box.width + 2 * kEdge,
                       blob.box.height + 2 * kEdge);
  const int reach = std::max(3, std::max(blob.box.width, blob.box.height) / 2);
  const cv::Rect outer = cv::Rect(inner.x - reach, inner.y - reach, inner.width + 2 * reach,
                                  inner.height + 2 * reach) &
                         cv::Rect(0, 0, depth.cols, depth.rows);
  heights_.clear();
  for (int row = outer.y; row < outer.br().y; ++row) {
    const auto* const mm = depth.ptr<std::uint16_t>(row);
    const std::uint8_t* const shell = mask_.ptr(row);
    for (int column = outer.x; column < outer.br().x; ++column) {
      if (mm[column] == 0 || shell[column] != 0 || inner.contains({column, row})) continue;
      heights_.push_back(height_of(0.001 * mm[column] * intrinsics_.ray(column, row)));
    }
  }
  if (heights_.size() < kEnough) return 0.0;
  // The lower quarter, as what else stands around stands above the floor.
  const auto floor = heights_.begin() + static_cast<std::ptrdiff_t>(heights_.size() / 4);
  std::nth_element(heights_.begin(), floor, heights_.end());
  return *floor;
}

bool EggDetector::has_size_of_egg(double length, double width, double pixel) const {
  // Half a pixel more or less on each side of the outline.
  return length >= config_.min_length - pixel && length <= config_.max_length + pixel &&
         width >= config_.min_width - pixel && width <= config_.max_width + pixel;
}

Eigen::Matrix3d EggDetector::covariance(const Eigen::Vector3d& ray, double z, int pixels,
                                        bool cut) const {
  const double beyond = cut ? world::kEggHalfLength : 0.0;
  const double across = std::hypot(config_.pixel_stddev * z / intrinsics_.fx, beyond);
  const double noise =
      config_.depth_noise.stddev(z) / std::sqrt(std::max(1.0, pixels / kPixelsOfOneError));
  const double along = std::hypot(noise * ray.norm(), config_.depth_bias, beyond);
  const Eigen::Vector3d axis = ray.normalized();
  return across * across * Eigen::Matrix3d::Identity() +
         (along * along - across * across) * axis * axis.transpose();
}

std::optional<Detection> EggDetector::judge(const Blob& blob, const cv::Mat& depth) {
  if (blob.fill() < config_.min_fill) return std::nullopt;
  const auto surface = surface_depth(blob, depth);
  if (!surface) return std::nullopt;
  const Eigen::Vector3d ray = intrinsics_.ray(blob.column, blob.row);
  const double z = surface->mean + 2.0 / 3.0 * kHalfThickness / ray.norm();
  if (z > config_.max_depth) return std::nullopt;

  // Pixels away from the optical axis see less of an object of the same distance.
  const double pixel = z / intrinsics_.fx;
  const double length = 2.0 * blob.half_long * pixel;
  const double width = 2.0 * blob.half_short * pixel;
  if (!has_size_of_egg(length, width, pixel)) return std::nullopt;
  const Eigen::Vector3d center = z * ray;
  const double height = height_of(center);
  const double above_floor = height - floor_around(blob, depth);
  if (std::abs(height) > config_.floor_tolerance || above_floor < config_.min_height ||
      above_floor > config_.max_height) {
    return std::nullopt;
  }

  const double size = std::abs(std::log(blob.area * pixel * pixel / kOutline)) / std::log(4.0);
  const double full = std::min(1.0, blob.fill());
  Detection egg;
  egg.class_id = "egg";
  egg.score = full * std::max(0.0, 1.0 - size) * (blob.at_border ? 0.5 : 1.0);
  egg.position = center;
  egg.covariance = covariance(ray, z, surface->pixels, blob.at_border);
  const double c = std::cos(blob.angle);
  const double s = std::sin(blob.angle);
  egg.size << std::hypot(length * c, width * s), std::hypot(length * s, width * c),
      2.0 * kHalfThickness;
  return egg;
}

std::vector<Blob> EggDetector::parts_of(const Blob& blob, const cv::Mat& depth) {
  constexpr double kLarge = 1.3;  // of an egg's outline
  constexpr double kTwo = 2.4;    // of the same: no more than two eggs
  constexpr double kStretched = 1.3;
  const auto surface = surface_depth(blob, depth);
  if (!surface) return {};
  const double per_metre = intrinsics_.fx / surface->mean;
  const double outlines = blob.area / (kOutline * per_metre * per_metre);
  if (outlines < kLarge) return {};
  // One that stands before the other joins it by a wide neck: deeper cores, until there are two.
  for (const double core : {0.5, 0.6, 0.7, 0.8, 0.9}) {  // of an egg's half width
    const double inside = core * world::kEggHalfWidth * per_metre;
    auto parts = split_blob(blob, inside, labels_, next_label_);
    next_label_ += static_cast<int>(parts.size());
    if (!parts.empty()) return parts;
  }
  if (outlines > kTwo || blob.half_long < kStretched * blob.half_short) return {};
  auto halves = halve_blob(blob, labels_, next_label_);
  next_label_ += static_cast<int>(halves.size());
  return halves;
}

std::vector<Detection> EggDetector::detect(const Frame& frame) {
  segment(frame.colour);
  // Of no interest: larger than some eggs right before the lens.
  const int max_area = mask_.rows * mask_.cols / 16;
  const auto blobs = find_blobs(mask_, config_.min_area, max_area, labels_);
  next_label_ = blobs.empty() ? 1 : blobs.back().label + 1;
  std::vector<Detection> eggs;
  for (const Blob& blob : blobs) {
    if (auto egg = judge(blob, frame.depth)) {
      eggs.push_back(std::move(*egg));
      continue;
    }
    for (const Blob& part : parts_of(blob, frame.depth)) {
      if (part.area < config_.min_area) continue;
      if (auto egg = judge(part, frame.depth)) eggs.push_back(std::move(*egg));
    }
  }
  return eggs;
}

}  // namespace coop::camera_driver
