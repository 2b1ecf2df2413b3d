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

bool reaches_border(const cv::Rect& box, const cv::Size& picture) {
  return box.x == 0 || box.y == 0 || box.br().x == picture.width || box.br().y == picture.height;
}

/// Gives each pixel of the blob to the part `part_of(column, row)` says.
template <class PartOf>
std::vector<Blob> divide(const Blob& blob, cv::Mat& labels, int next_label, std::size_t count,
                         PartOf part_of) {
  std::vector<Blob> parts(count);
  for (std::size_t i = 0; i < count; ++i) parts[i].label = next_label + static_cast<int>(i);
  for (int row = blob.box.y; row < blob.box.br().y; ++row) {
    for (int column = blob.box.x; column < blob.box.br().x; ++column) {
      int& label = labels.at<int>(row, column);
      if (label != blob.label) continue;
      Blob& part = parts[static_cast<std::size_t>(part_of(column, row))];
      label = part.label;
      const cv::Rect pixel(column, row, 1, 1);
      part.box = part.area == 0 ? pixel : part.box | pixel;
      ++part.area;
    }
  }
  std::erase_if(parts, [](const Blob& part) { return part.area == 0; });
  for (Blob& part : parts) {
    part.at_border = reaches_border(part.box, labels.size());
    measure(labels, part);
  }
  return parts;
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
    blob.at_border = reaches_border(blob.box, mask.size());
    measure(labels, blob);
    blobs.push_back(blob);
  }
  return blobs;
}

std::vector<Blob> split_blob(const Blob& blob, double core, cv::Mat& labels, int next_label) {
  // One pixel of nothing around, so that the box's border counts as outline.
  cv::Mat inside(blob.box.height + 2, blob.box.width + 2, CV_8UC1, cv::Scalar(0));
  cv::compare(labels(blob.box), blob.label, inside(cv::Rect({1, 1}, blob.box.size())), cv::CMP_EQ);
  cv::Mat to_outline;
  cv::distanceTransform(inside, to_outline, cv::DIST_L2, 5);
  const cv::Mat elsewhere = to_outline <= core;
  cv::Mat to_core;
  cv::Mat nearest;  // label of the nearest core, from 1 up
  cv::distanceTransform(elsewhere, to_core, nearest, cv::DIST_L2, 5, cv::DIST_LABEL_CCOMP);
  double count = 0.0;
  cv::minMaxLoc(nearest, nullptr, &count);
  if (count < 2.0 || cv::countNonZero(elsewhere) == static_cast<int>(elsewhere.total())) return {};

  return divide(blob, labels, next_label, static_cast<std::size_t>(count),
                [&](int column, int row) {
                  return nearest.at<int>(row - blob.box.y + 1, column - blob.box.x + 1) - 1;
                });
}

std::vector<Blob> halve_blob(const Blob& blob, cv::Mat& labels, int next_label) {
  const double c = std::cos(blob.angle);
  const double s = std::sin(blob.angle);
  return divide(blob, labels, next_label, 2, [&](int column, int row) {
    return c * (column - blob.column) + s * (row - blob.row) < 0.0 ? 0 : 1;
  });
}

}  // namespace coop::camera_driver
