#include "camera_driver/pen_detector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/config/error.hpp"
#include "core/world/shapes.hpp"

namespace coop::camera_driver {
namespace {

constexpr int kMaxHue = 180;

double area_of(double radius) {
  return std::numbers::pi * radius * radius;
}

double radius_of(double area) {
  return std::sqrt(area / std::numbers::pi);
}

Detection detection(const char* class_id, const Eigen::Vector3d& place, double radius,
                    double height, double stddev) {
  Detection found;
  found.class_id = class_id;
  found.score = 1.0;
  found.position = place;
  found.covariance = stddev * stddev * Eigen::Matrix3d::Identity();
  found.size << 2.0 * radius, 2.0 * radius, height;
  return found;
}

}  // namespace

void PenDetectorConfig::describe(config::Fields& fields) {
  const auto colour = [&](const char* key, int& value, const char* help) {
    fields.integer(key, value, {.help = help, .min = 0, .max = 255});
  };
  const auto length = [&](const char* key, double& value, const char* help) {
    fields.number(key, value, {.unit = "m", .help = help, .min = 0.001, .max = 5});
  };
  colour("heap_max_value", heap_max_value, "manure is no brighter");
  colour("heap_min_saturation", heap_min_saturation, "manure is no greyer");
  colour("heap_max_hue", heap_max_hue, "of manure, in units of 2 degrees from red to yellow");
  length("heap_min_radius", heap_min_radius, "of a disc of the same area");
  length("heap_max_radius", heap_max_radius, "of a disc of the same area");
  fields.number("heap_min_fill", heap_min_fill,
                {.unit = "1", .help = "area in the ellipse's", .min = 0, .max = 1});
  colour("pig_min_value", pig_min_value, "pigs are no darker");
  colour("pig_min_saturation", pig_min_saturation, "pigs are no greyer");
  colour("pig_max_hue", pig_max_hue, "of pigs, on either side of red, in units of 2 degrees");
  length("pig_height", pig_height, "of a pig's back");
  length("pig_min_radius", pig_min_radius, "of a disc of the same area");
  length("pig_max_radius", pig_max_radius, "of a disc of the same area; larger ones are several");
  length("heap_stddev", heap_stddev, "deviation of a heap's place");
  length("pig_stddev", pig_stddev, "deviation of a pig's place");
}

void PenDetectorConfig::validate() const {
  if (heap_min_radius >= heap_max_radius) {
    throw config::Error("heap_min_radius: expected less than heap_max_radius");
  }
  if (pig_min_radius >= pig_max_radius) {
    throw config::Error("pig_min_radius: expected less than pig_max_radius");
  }
}

PenDetector::PenDetector(const PenDetectorConfig& config, const OverheadMount& mount)
    : config_(config),
      intrinsics_(mount.intrinsics()),
      camera_in_map_(mount.camera_in_map()),
      pixels_per_metre_(intrinsics_.fx / (mount.height - 0.5 * config.pig_height)) {}

void PenDetector::segment(const cv::Mat& colour) {
  cv::cvtColor(colour, hsv_, cv::COLOR_RGB2HSV);
  cv::inRange(hsv_, cv::Scalar(0, config_.heap_min_saturation, 0),
              cv::Scalar(config_.heap_max_hue, 255, config_.heap_max_value), heaps_);
  cv::Mat beyond_red;
  cv::inRange(hsv_, cv::Scalar(0, config_.pig_min_saturation, config_.pig_min_value),
              cv::Scalar(config_.pig_max_hue, 255, 255), pigs_);
  cv::inRange(
      hsv_,
      cv::Scalar(kMaxHue - config_.pig_max_hue, config_.pig_min_saturation, config_.pig_min_value),
      cv::Scalar(kMaxHue, 255, 255), beyond_red);
  cv::bitwise_or(pigs_, beyond_red, pigs_);
  // A majority of 3 x 3 rounds outlines and drops single pixels of noise.
  cv::medianBlur(heaps_, heaps_, 3);
  cv::medianBlur(pigs_, pigs_, 3);
}

Eigen::Vector3d PenDetector::place_of(const Blob& blob, double height) const {
  const Eigen::Vector3d direction =
      camera_in_map_.linear() * intrinsics_.ray(blob.column, blob.row);
  const Eigen::Vector3d from = camera_in_map_.translation();
  return from + (height - from.z()) / direction.z() * direction;
}

double PenDetector::lean_of(const Blob& blob) const {
  const double height = camera_in_map_.translation().z();
  const double from_middle =
      std::hypot(blob.column - intrinsics_.cx, blob.row - intrinsics_.cy) / intrinsics_.fx;
  const double middle = height - 0.5 * config_.pig_height;
  return from_middle * middle * (middle / (height - config_.pig_height) - middle / height);
}

/// The silhouette of a disc of radius r that leans by l has about the area pi r^2 + 2 r l.
double PenDetector::pig_radius_of(const Blob& blob) const {
  const double area = blob.area / (pixels_per_metre_ * pixels_per_metre_);
  const double lean = lean_of(blob);
  return (std::sqrt(lean * lean + std::numbers::pi * area) - lean) / std::numbers::pi;
}

/// Pigs that stand side by side: deeper and deeper cores, until the region falls into several.
std::vector<Blob> PenDetector::whole_pigs(const Blob& blob) {
  if (pig_radius_of(blob) <= config_.pig_max_radius) return {blob};
  for (const double core : {0.5, 0.7, 0.85, 1.0}) {  // of the smallest pig's radius
    auto parts =
        split_blob(blob, core * config_.pig_min_radius * pixels_per_metre_, labels_, next_label_);
    next_label_ += static_cast<int>(parts.size());
    if (!parts.empty()) return parts;
  }
  return {blob};
}

std::vector<Detection> PenDetector::find_pigs() {
  const int min_area = static_cast<int>(0.5 * area_of(config_.pig_min_radius * pixels_per_metre_));
  const auto blobs = find_blobs(pigs_, min_area, pigs_.rows * pigs_.cols, labels_);
  next_label_ = blobs.empty() ? 1 : blobs.back().label + 1;
  std::vector<Detection> pigs;
  for (const Blob& blob : blobs) {
    for (const Blob& part : whole_pigs(blob)) {
      const double radius = pig_radius_of(part);
      // One cut by the border is still a pig.
      if (radius < config_.pig_min_radius && !part.at_border) continue;
      pigs.push_back(detection("pig", place_of(part, 0.5 * config_.pig_height), radius,
                               config_.pig_height, config_.pig_stddev));
    }
  }
  return pigs;
}

bool PenDetector::beside_a_pig(const Blob& blob) const {
  constexpr int kEdge = 3;  // px
  const cv::Rect around = cv::Rect(blob.box.x - kEdge, blob.box.y - kEdge,
                                   blob.box.width + 2 * kEdge, blob.box.height + 2 * kEdge) &
                          cv::Rect(0, 0, pigs_.cols, pigs_.rows);
  return cv::countNonZero(pigs_(around)) > 0;
}

std::vector<Detection> PenDetector::find_heaps() {
  const double pixels_per_metre = intrinsics_.fx / camera_in_map_.translation().z();
  const int smallest = static_cast<int>(area_of(config_.heap_min_radius * pixels_per_metre));
  const int largest = static_cast<int>(area_of(config_.heap_max_radius * pixels_per_metre));
  std::vector<Detection> heaps;
  for (const Blob& blob : find_blobs(heaps_, smallest, largest, labels_)) {
    if (blob.fill() < config_.heap_min_fill) continue;
    const double radius = radius_of(blob.area) / pixels_per_metre;
    const bool may_be_cut = blob.at_border || beside_a_pig(blob);
    const double stddev =
        may_be_cut ? std::hypot(config_.heap_stddev, radius) : config_.heap_stddev;
    Detection heap = detection("manure", place_of(blob, 0.0), radius, world::kHeapHeight, stddev);
    if (may_be_cut) heap.score *= 0.5;
    heaps.push_back(std::move(heap));
  }
  return heaps;
}

PenSighting PenDetector::detect(const cv::Mat& colour) {
  segment(colour);
  PenSighting seen;
  seen.pigs = find_pigs();
  seen.heaps = find_heaps();
  return seen;
}

}  // namespace coop::camera_driver
