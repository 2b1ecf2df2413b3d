#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "camera_driver/blob.hpp"
#include "camera_driver/intrinsics.hpp"
#include "core/config/fields.hpp"
#include "core/detection.hpp"

namespace coop::camera_driver {

/// Eggs in a still picture without depth, from a camera at a known place: their size in the picture
/// is known within a factor.
struct PhotographConfig {
  double min_width = 0.032;   ///< short axis of an egg, of the picture's width
  double max_width = 0.065;   ///< the same
  double max_aspect = 1.65;   ///< long by short axis
  double min_fill = 0.94;     ///< area in that of the ellipse of the same moments
  double min_outline = 0.50;  ///< share of the outline that stands off from what is around it
  double max_texture = 0.55;  ///< fine detail inside, of that of the roughest tenth of the picture
  double min_contrast = 2.5;  ///< difference of colour at the outline, in units of CIE Lab
  int levels = 24;            ///< thresholds a channel

  void describe(config::Fields& fields);
  void validate() const;  ///< throws config::Error
};

/// An egg as the ellipse of its region's moments.
struct PhotographedEgg {
  Blob ellipse;
  double score = 0.0;  ///< 0 to 1
};

/// Whatever colour the shells and the litter have, an egg is a smooth ellipse on rough ground.
/// Regions above each of a series of thresholds, of the channels of CIE Lab and of smoothness, are
/// candidates (those of several eggs are cut at their necks); a candidate counts if size, aspect
/// and fill are an egg's, its inside is smooth and all round its outline the colour
/// changes to the same side; of overlapping
/// ones the best is kept. `picture`: CV_8UC3, red, green, blue.
[[nodiscard]] std::vector<PhotographedEgg> find_eggs(const PhotographConfig& config,
                                                     const cv::Mat& picture);

/// Where the egg lies, m in the optical frame, if it is a duck egg: one picture tells the depth by
/// the egg's size only, which differs by a tenth from egg to egg. That is its deviation along the
/// ray.
[[nodiscard]] Detection to_detection(const PhotographedEgg& egg, const Intrinsics& intrinsics);

}  // namespace coop::camera_driver
