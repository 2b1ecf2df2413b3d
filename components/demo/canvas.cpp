#include "demo/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace coop::demo {
namespace {

constexpr int kLegendHeight = 40;

cv::Rect known_part(const OccupancyGrid& grid) {
  cv::Rect box;
  for (int y = 0; y < grid.geometry.height; ++y) {
    for (int x = 0; x < grid.geometry.width; ++x) {
      if (grid[{x, y}] >= 0) box |= cv::Rect(x, y, 1, 1);
    }
  }
  return box.empty() ? cv::Rect(0, 0, grid.geometry.width, grid.geometry.height) : box;
}

cv::Rect part_within(const GridGeometry& geometry, const Eigen::AlignedBox2d& shown) {
  const Cell low = geometry.cell_of(shown.min());
  const Cell high = geometry.cell_of(shown.max());
  return cv::Rect(cv::Point(low.x, low.y), cv::Point(high.x + 1, high.y + 1)) &
         cv::Rect(0, 0, geometry.width, geometry.height);
}

}  // namespace

cv::Scalar map_colour(std::int8_t value) {
  if (value < 0) return cv::Scalar(205, 205, 205);
  const double grey = 254.0 * (100.0 - value) / 100.0;
  return cv::Scalar(grey, grey, grey);
}

Canvas::Canvas(const OccupancyGrid& grid, Colour colour, double pixels_per_metre)
    : Canvas(grid, colour, pixels_per_metre, known_part(grid)) {}

Canvas::Canvas(const OccupancyGrid& grid, Colour colour, double pixels_per_metre,
               const Eigen::AlignedBox2d& shown)
    : Canvas(grid, colour, pixels_per_metre, part_within(grid.geometry, shown)) {}

Canvas::Canvas(const OccupancyGrid& grid, Colour colour, double pixels_per_metre,
               const cv::Rect& part)
    : geometry_(grid.geometry), part_(part), scale_(pixels_per_metre * geometry_.resolution) {
  cv::Mat cells(part_.height, part_.width, CV_8UC3);
  for (int y = 0; y < part_.height; ++y) {
    for (int x = 0; x < part_.width; ++x) {
      const cv::Scalar c = colour(grid[{part_.x + x, part_.y + y}]);
      cells.at<cv::Vec3b>(part_.height - 1 - y, x) =
          cv::Vec3b(cv::saturate_cast<uchar>(c[0]), cv::saturate_cast<uchar>(c[1]),
                    cv::saturate_cast<uchar>(c[2]));
    }
  }
  cv::resize(cells, image_, {}, scale_, scale_, cv::INTER_NEAREST);
}

cv::Point Canvas::pixel(const Eigen::Vector2d& point) const {
  const double x = (point.x() - geometry_.origin.x()) / geometry_.resolution - part_.x;
  const double y = (point.y() - geometry_.origin.y()) / geometry_.resolution - part_.y;
  return {static_cast<int>(std::lround(x * scale_)),
          static_cast<int>(std::lround((part_.height - y) * scale_))};
}

int Canvas::pixels(double metres) const {
  return static_cast<int>(std::lround(metres / geometry_.resolution * scale_));
}

void Canvas::line(const std::vector<Eigen::Vector2d>& points, const cv::Scalar& colour, int width) {
  std::vector<cv::Point> along;
  for (const auto& point : points) along.push_back(pixel(point));
  cv::polylines(image_, along, false, colour, width, cv::LINE_AA);
}

void Canvas::label(const cv::Point& at, const std::string& text, const cv::Scalar& colour) {
  cv::putText(image_, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.55, kWhite, 4, cv::LINE_AA);
  cv::putText(image_, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.55, colour, 1, cv::LINE_AA);
}

void Canvas::tracks(const std::vector<TrackPoint>& track) {
  if (track.empty()) return;
  std::vector<Eigen::Vector2d> truth;
  std::vector<Eigen::Vector2d> estimate;
  for (const TrackPoint& point : track) {
    truth.push_back(point.truth_in_map.position());
    estimate.push_back(point.estimate_in_map.position());
  }
  line(truth, kTruthColour, 3);
  line(estimate, kEstimateColour, 1);
  const cv::Point start = pixel(truth.front());
  cv::circle(image_, start, 7, kTruthColour, cv::FILLED, cv::LINE_AA);
  label(start + cv::Point(10, 5), "start", kTruthColour);
}

Legend::Legend(const cv::Mat& image, int least_width)
    : row_(image.rows + kLegendHeight / 2),
      image_(image.rows + kLegendHeight, std::max(image.cols, least_width), CV_8UC3, kWhite) {
  image.copyTo(image_(cv::Rect(0, 0, image.cols, image.rows)));
}

void Legend::entry(const cv::Scalar& colour, const std::string& text) {
  cv::rectangle(image_, cv::Rect(column_, row_ - 8, 18, 16), colour, cv::FILLED);
  cv::rectangle(image_, cv::Rect(column_, row_ - 8, 18, 16), kBlack, 1);
  cv::putText(image_, text, {column_ + 24, row_ + 5}, cv::FONT_HERSHEY_SIMPLEX, 0.45, kBlack, 1,
              cv::LINE_AA);
  column_ += 42 + cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, nullptr).width;
}

}  // namespace coop::demo
