#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace coop::camera_driver {

/// A connected region of a picture and the ellipse of the same area moments.
struct Blob {
  int label = 0;  ///< of its pixels
  int area = 0;   ///< px
  cv::Rect box;
  double column = 0.0;      ///< centre of area, px
  double row = 0.0;         ///< px
  double half_long = 0.0;   ///< half axes of the ellipse, px
  double half_short = 0.0;  ///< px
  double angle = 0.0;       ///< rad from the columns' axis towards the rows', of the long axis
  bool at_border = false;   ///< reaches the picture's border: a part may lie outside

  /// Area in the ellipse's: near 1 for an ellipse, less for what is bent, ragged or holed.
  [[nodiscard]] double fill() const;
};

/// Regions of non-zero pixels, 8-connected, of at least `min_area` pixels and no larger than
/// `max_area`. `labels` (CV_32S) gets every pixel's label.
[[nodiscard]] std::vector<Blob> find_blobs(const cv::Mat& mask, int min_area, int max_area,
                                           cv::Mat& labels);

/// Parts of a blob that hang together by necks only: those of its pixels that lie farther than
/// `core` px from its outline fall into several cores, and every pixel goes to the nearest one. The
/// parts get labels from `next_label` up, in `labels` too. Nothing where there is one core or none.
[[nodiscard]] std::vector<Blob> split_blob(const Blob& blob, double core, cv::Mat& labels,
                                           int next_label);

/// The two halves of a blob on either side of its short axis, labelled likewise.
[[nodiscard]] std::vector<Blob> halve_blob(const Blob& blob, cv::Mat& labels, int next_label);

}  // namespace coop::camera_driver
