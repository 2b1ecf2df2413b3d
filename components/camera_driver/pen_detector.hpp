#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "camera_driver/blob.hpp"
#include "camera_driver/overhead_mount.hpp"
#include "core/config/fields.hpp"
#include "core/detection.hpp"

namespace coop::camera_driver {

/// Colours in OpenCV's numbers: hue in units of 2 degrees, saturation and value in 256ths.
struct PenDetectorConfig {
  int heap_max_value = 115;       ///< manure is dark
  int heap_min_saturation = 70;   ///< and brown: water on concrete is grey
  int heap_max_hue = 28;          ///< from red to yellow
  double heap_min_radius = 0.03;  ///< m, of a disc of the same area
  double heap_max_radius = 0.25;  ///< m
  double heap_min_fill = 0.75;    ///< area in that of the ellipse of the same moments
  int pig_min_value = 150;        ///< pigs are bright
  int pig_min_saturation = 45;    ///< and pink
  int pig_max_hue = 12;           ///< on either side of red
  double pig_height = 0.40;       ///< m of their backs
  double pig_min_radius = 0.12;   ///< m, of a disc of the same area
  double pig_max_radius = 0.33;   ///< m: larger ones are several
  double heap_stddev = 0.01;      ///< m, of a place
  double pig_stddev = 0.05;       ///< m, of a place

  void describe(config::Fields& fields);
  void validate() const;  ///< throws config::Error
};

/// What a picture of a pen shows, in map.
struct PenSighting {
  std::vector<Detection> pigs;   ///< class "pig", at half their height
  std::vector<Detection> heaps;  ///< class "manure", on the floor
};

/// Pigs and manure in colour pictures from under the ceiling. Pixels of their colours are joined to
/// regions, which count by size and shape; the place is where the ray through a region's middle
/// meets the height of what is seen: the floor, or the middle of a pig's height, as a standing
/// pig's silhouette is that of its back and its feet together. The farther from the picture's
/// middle, the more a pig leans outwards and the larger it looks. Regions larger than a pig are cut
/// at their necks. A heap whose region reaches the border or a pig's region may be cut or partly
/// hidden: half the score, and a deviation larger by its radius.
class PenDetector {
 public:
  PenDetector(const PenDetectorConfig& config, const OverheadMount& mount);

  /// `colour`: CV_8UC3: red, green, blue, of the mount's size.
  [[nodiscard]] PenSighting detect(const cv::Mat& colour);

 private:
  void segment(const cv::Mat& colour);
  [[nodiscard]] std::vector<Detection> find_pigs();
  [[nodiscard]] std::vector<Detection> find_heaps();
  [[nodiscard]] std::vector<Blob> whole_pigs(const Blob& blob);
  [[nodiscard]] double pig_radius_of(const Blob& blob) const;
  /// Between the middles of a pig's feet and back in the picture, m at half its height.
  [[nodiscard]] double lean_of(const Blob& blob) const;
  [[nodiscard]] bool beside_a_pig(const Blob& blob) const;
  /// The point at `height` on the ray through the blob's middle, m in map.
  [[nodiscard]] Eigen::Vector3d place_of(const Blob& blob, double height) const;

  PenDetectorConfig config_;
  Intrinsics intrinsics_;
  Pose3 camera_in_map_;
  double pixels_per_metre_;  ///< at half a pig's height
  cv::Mat hsv_;
  cv::Mat pigs_;   ///< mask
  cv::Mat heaps_;  ///< mask
  cv::Mat labels_;
  int next_label_ = 1;
};

}  // namespace coop::camera_driver
