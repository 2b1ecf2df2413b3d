#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "camera_driver/blob.hpp"
#include "camera_driver/depth_noise.hpp"
#include "camera_driver/frame.hpp"
#include "camera_driver/intrinsics.hpp"
#include "core/config/fields.hpp"
#include "core/detection.hpp"
#include "core/pose.hpp"

namespace coop::camera_driver {

struct EggDetectorConfig {
  int min_brightness = 125;       ///< of the strongest channel, in 256ths
  double max_saturation = 0.20;   ///< 1 - weakest / strongest channel: shells are nearly white
  int min_area = 12;              ///< px
  double max_depth = 4.0;         ///< m, farther eggs are too few pixels to tell
  double min_valid_depth = 0.5;   ///< share of an egg's pixels that have depth
  double min_width = 0.030;       ///< m, short axis seen
  double max_width = 0.060;       ///< m
  double min_length = 0.038;      ///< m, long axis seen
  double max_length = 0.080;      ///< m
  double min_fill = 0.80;         ///< area in that of the ellipse of the same moments
  double min_height = 0.008;      ///< m of an egg's centre above the floor around it
  double max_height = 0.045;      ///< m
  double floor_tolerance = 0.08;  ///< m, of its height above the floor plane of base_link
  double pixel_stddev = 0.35;     ///< px, of a centre
  double depth_bias = 0.003;      ///< m, deviation of what the depth's noise does not say
  DepthNoise depth_noise;         ///< of the camera

  void describe(config::Fields& fields);
  void validate() const;  ///< throws config::Error
};

/// Eggs in pictures with depth. Nearly white, bright pixels are joined to regions; a region counts
/// as an egg if the ellipse of its moments has the size of one at its depth, it fills that ellipse,
/// and its centre lies about half an egg above the floor around it, as depth tells: a flat patch of
/// the same outline is none, and the robot may pitch a little.
///
/// A region too large for one egg is cut where it is narrow: eggs that touch, an egg on something
/// pale.
///
/// The centre lies behind the surface seen: a sphere's visible half has the mean depth of its
/// centre less 2/3 of its radius. Covariance: pixel_stddev across; along the ray the depth's noise,
/// of which neighbouring pixels share a part, and depth_bias. An egg cut by the picture's border is
/// reported with half its score and a deviation larger by half an egg.
class EggDetector {
 public:
  /// `camera_in_base`: camera_optical_frame; the floor is z = 0 of base_link.
  EggDetector(const EggDetectorConfig& config, const Intrinsics& intrinsics,
              const Pose3& camera_in_base);

  /// In camera_optical_frame. The frame must have the intrinsics' size.
  [[nodiscard]] std::vector<Detection> detect(const Frame& frame);

 private:
  struct SurfaceDepth {
    double mean = 0.0;  ///< m
    int pixels = 0;
  };
  void segment(const cv::Mat& colour);
  [[nodiscard]] std::optional<SurfaceDepth> surface_depth(const Blob& blob, const cv::Mat& depth);
  /// Parts of a region that is larger than an egg at its depth, or none.
  [[nodiscard]] std::vector<Blob> parts_of(const Blob& blob, const cv::Mat& depth);
  [[nodiscard]] std::optional<Detection> judge(const Blob& blob, const cv::Mat& depth);
  [[nodiscard]] double height_of(const Eigen::Vector3d& point) const;
  /// Height of the floor around a blob above the plane z = 0 of base_link, m.
  [[nodiscard]] double floor_around(const Blob& blob, const cv::Mat& depth);
  [[nodiscard]] bool has_size_of_egg(double length, double width, double pixel) const;
  [[nodiscard]] Eigen::Matrix3d covariance(const Eigen::Vector3d& ray, double z, int pixels,
                                           bool cut) const;

  EggDetectorConfig config_;
  Intrinsics intrinsics_;
  Pose3 camera_in_base_;
  cv::Mat mask_;
  cv::Mat labels_;
  int next_label_ = 1;
  std::vector<std::uint16_t> depths_;  ///< of one blob, mm
  std::vector<double> heights_;        ///< of the floor around one blob, m
};

}  // namespace coop::camera_driver
