#pragma once
#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "demo/record.hpp"

namespace coop::demo {

// Blue, green, red.
inline const cv::Scalar kTruthColour(60, 140, 30);
inline const cv::Scalar kEstimateColour(0, 120, 255);
inline const cv::Scalar kBlack(0, 0, 0);
inline const cv::Scalar kWhite(255, 255, 255);

/// A cell of a map as map_server shows it.
[[nodiscard]] cv::Scalar map_colour(std::int8_t value);

/// A drawing of a grid, y upwards, with the mapping from metres to pixels.
class Canvas {
 public:
  using Colour = cv::Scalar (*)(std::int8_t);

  /// The part of the grid that holds anything, so that the picture is not mostly margin.
  Canvas(const OccupancyGrid& grid, Colour colour, double pixels_per_metre);
  /// The cells within a rectangle, m in map.
  Canvas(const OccupancyGrid& grid, Colour colour, double pixels_per_metre,
         const Eigen::AlignedBox2d& shown);

  /// From now on places are told in the frame of another map of the same cells.
  void use_origin_of(const OccupancyGrid& grid) { geometry_.origin = grid.geometry.origin; }

  [[nodiscard]] cv::Point pixel(const Eigen::Vector2d& point) const;
  [[nodiscard]] int pixels(double metres) const;
  void line(const std::vector<Eigen::Vector2d>& points, const cv::Scalar& colour, int width);
  void label(const cv::Point& at, const std::string& text, const cv::Scalar& colour);
  /// Where the robot was (thick) and thought it was (thin), and its start.
  void tracks(const std::vector<TrackPoint>& track);

  [[nodiscard]] cv::Mat& image() { return image_; }

 private:
  Canvas(const OccupancyGrid& grid, Colour colour, double pixels_per_metre, const cv::Rect& part);

  GridGeometry geometry_;
  cv::Rect part_;
  double scale_;  ///< pixels a cell
  cv::Mat image_;
};

/// A key to colours below a picture.
class Legend {
 public:
  explicit Legend(const cv::Mat& image, int least_width);
  void entry(const cv::Scalar& colour, const std::string& text);
  [[nodiscard]] const cv::Mat& image() const { return image_; }

 private:
  int row_;
  int column_ = 12;
  cv::Mat image_;
};

}  // namespace coop::demo
