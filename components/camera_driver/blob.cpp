#include "camera_driver/blob.hpp"

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace coop::camera_driver {
namespace {

/// Centre and ellipse from the moments of the blob's pixels, each a square of edge 1.
void measure(const cv::Mat& labels, Blob& blob) {
  double sum_x = 0.0;
  double sum_y = 0.0;
  double sum_xx = 0.0;
  double sum_yy = 0.0;
  double sum_xy = 0.0;
  for (int row = blob.box.y; row < blob.box.br().y; ++row) {
    const auto* const label = labels.ptr<int>(row);
    for (int column = blob.box.x; column < blob.box.br().x; ++column) {
      if (label[column] != blob.label) continue;
      const double x = column - blob.box.x;
      const double y = row - blob.box.y;
      sum_x += x;
      sum_y += y;
      sum_xx += x * x;
      sum_yy += y * y;
      sum_xy += x * y;
    }
  }
  const double n = blob.area;
  const double mean_x = sum_x / n;
  const double mean_y = sum_y / n;
  const double xx = sum_xx / n - mean_x * mean_x + 1.0 / 12.0;
  const double yy = sum_yy / n - mean_y * mean_y + 1.0 / 12.0;
  const double xy = sum_xy / n - mean_x * mean_y;
  const double middle = 0.5 * (xx + yy);
  const double spread = std::hypot(0.5 * (xx - yy), xy);
  blob.column = blob.box.x + mean_x;
  blob.row = blob.box.y + mean_y;
  // The second moment of a filled ellipse along an axis is the square of that half axis over 4.
  blob.half_long = 2.0 * std::sqrt(middle + spread);
  blob.half_short = 2.0 * std::sqrt(std::max(middle - spread, 0.0));
  blob.angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
}

}  // namespace

double Blob::fill() const {
  return area / (std::numbers::pi * half_long * half_short);
}

std::vector<Blob> find_blobs(const cv::Mat& mask, int min_area, int max_area, cv::Mat& labels) {
  cv::Mat statistics;
  cv::Mat centers;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centers, 8, CV_32S);
  std::vector<Blob> blobs;
  for (int label = 1; label < count; ++label) {
    const int* const row = statistics.ptr<int>(label);
    const int area = row[cv::CC_STAT_AREA];
    if (area < min_area || area > max_area) continue;
    Blob blob;
    blob.label = label;
    blob.area = area;
    blob.box = {row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP], row[cv::CC_STAT_WIDTH],
                row[cv::CC_STAT_HEIGHT]};
    blob.at_border = blob.box.x == 0 || blob.box.y == 0 || blob.box.br().x == mask.cols ||
                     blob.box.br().y == mask.rows;
    measure(labels, blob);
    blobs.push_back(blob);
  }
  return blobs;
}

}  // namespace coop::camera_driver
