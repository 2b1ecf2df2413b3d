#include "demo/picture.hpp"

#include <algorithm>
#include <functional>
#include <opencv2/imgproc.hpp>

namespace coop::demo {
namespace {

const cv::Scalar kPurple(160, 32, 128);
const cv::Scalar kLightBlue(235, 206, 135);
const cv::Scalar kFreeColour(240, 240, 240);
const cv::Scalar kUnknownColour(170, 170, 170);
const cv::Scalar kTruthColour(60, 140, 30);
const cv::Scalar kEstimateColour(0, 120, 255);
const cv::Scalar kBlack(0, 0, 0);
const cv::Scalar kWhite(255, 255, 255);
constexpr int kLegendHeight = 40;

cv::Scalar restricted_colour(std::int8_t cost) {
  // Deep blue beside the obstacle, fading to free.
  const double ratio = static_cast<double>(cost) / 98.0;
  const cv::Scalar deep(220, 60, 30);
  return deep * ratio + kFreeColour * (1.0 - ratio);
}

cv::Scalar costmap_colour(std::int8_t cost) {
  if (cost < 0) return kUnknownColour;
  if (cost >= 100) return kPurple;
  if (cost == 99) return kLightBlue;
  return cost == 0 ? kFreeColour : restricted_colour(cost);
}

cv::Scalar map_colour(std::int8_t value) {
  if (value < 0) return cv::Scalar(205, 205, 205);
  const double grey = 254.0 * (100.0 - value) / 100.0;
  return cv::Scalar(grey, grey, grey);
}

/// The part of a grid that holds anything, so that the picture is not mostly margin.
cv::Rect known_part(const OccupancyGrid& grid) {
  cv::Rect box;
  for (int y = 0; y < grid.geometry.height; ++y) {
    for (int x = 0; x < grid.geometry.width; ++x) {
      if (grid[{x, y}] >= 0) box |= cv::Rect(x, y, 1, 1);
    }
  }
  return box.empty() ? cv::Rect(0, 0, grid.geometry.width, grid.geometry.height) : box;
}

/// A drawing of a grid, y upwards, with the mapping from metres to pixels.
class Canvas {
 public:
  Canvas(const OccupancyGrid& grid, const std::function<cv::Scalar(std::int8_t)>& colour)
      : geometry_(grid.geometry),
        part_(known_part(grid)),
        scale_(kPixelsPerMetre * geometry_.resolution) {
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

  [[nodiscard]] cv::Point pixel(const Eigen::Vector2d& point) const {
    const double x = (point.x() - geometry_.origin.x()) / geometry_.resolution - part_.x;
    const double y = (point.y() - geometry_.origin.y()) / geometry_.resolution - part_.y;
    return {static_cast<int>(std::lround(x * scale_)),
            static_cast<int>(std::lround((part_.height - y) * scale_))};
  }

  void line(const std::vector<Eigen::Vector2d>& points, const cv::Scalar& colour, int width) {
    std::vector<cv::Point> pixels;
    for (const auto& point : points) pixels.push_back(pixel(point));
    cv::polylines(image_, pixels, false, colour, width, cv::LINE_AA);
  }

  void label(const cv::Point& at, const std::string& text, const cv::Scalar& colour) {
    cv::putText(image_, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.55, kWhite, 4, cv::LINE_AA);
    cv::putText(image_, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.55, colour, 1, cv::LINE_AA);
  }

  [[nodiscard]] cv::Mat& image() { return image_; }

 private:
  GridGeometry geometry_;
  cv::Rect part_;
  double scale_;
  cv::Mat image_;
};

void draw_tracks(Canvas& canvas, const std::vector<TrackPoint>& track) {
  if (track.empty()) return;
  std::vector<Eigen::Vector2d> truth;
  std::vector<Eigen::Vector2d> estimate;
  for (const TrackPoint& point : track) {
    truth.push_back(point.truth_in_map.position());
    estimate.push_back(point.estimate_in_map.position());
  }
  canvas.line(truth, kTruthColour, 3);
  canvas.line(estimate, kEstimateColour, 1);
  const cv::Point start = canvas.pixel(truth.front());
  cv::circle(canvas.image(), start, 7, kTruthColour, cv::FILLED, cv::LINE_AA);
  canvas.label(start + cv::Point(10, 5), "start", kTruthColour);
}

void draw_eggs(Canvas& canvas, const Record& record) {
  for (const EggRecord& egg : record.eggs) {
    const cv::Point at = canvas.pixel(egg.egg_in_map);
    const bool picked = egg.state == "picked";
    cv::ellipse(canvas.image(), at, {9, 7}, 0, 0, 360, picked ? kWhite : cv::Scalar(60, 60, 230),
                cv::FILLED, cv::LINE_AA);
    cv::ellipse(canvas.image(), at, {9, 7}, 0, 0, 360, kBlack, 1, cv::LINE_AA);
    const auto place = std::ranges::find(record.order, egg.id);
    std::string text =
        place == record.order.end() ? egg.id : std::to_string(place - record.order.begin() + 1);
    if (!picked) text += " (" + egg.state + ")";
    canvas.label(at + cv::Point(12, -8), text, kBlack);
  }
}

cv::Mat with_legend(const cv::Mat& image) {
  cv::Mat out(image.rows + kLegendHeight, std::max(image.cols, 900), CV_8UC3, kWhite);
  image.copyTo(out(cv::Rect(0, 0, image.cols, image.rows)));
  int x = 12;
  const int y = image.rows + kLegendHeight / 2;
  const auto entry = [&](const cv::Scalar& colour, const std::string& text) {
    cv::rectangle(out, cv::Rect(x, y - 8, 18, 16), colour, cv::FILLED);
    cv::rectangle(out, cv::Rect(x, y - 8, 18, 16), kBlack, 1);
    cv::putText(out, text, {x + 24, y + 5}, cv::FONT_HERSHEY_SIMPLEX, 0.45, kBlack, 1, cv::LINE_AA);
    x += 42 + cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, nullptr).width;
  };
  entry(kPurple, "obstacle");
  entry(kLightBlue, "inscribed");
  entry(restricted_colour(80), "restricted");
  entry(kFreeColour, "free");
  entry(kUnknownColour, "unknown");
  entry(kTruthColour, "driven");
  entry(kEstimateColour, "estimated");
  entry(kWhite, "egg, number = order");
  return out;
}

}  // namespace

cv::Mat draw_run(const Record& record) {
  const bool has_costmap = !record.costmap.cells.empty();
  Canvas canvas(has_costmap ? record.costmap : record.map,
                has_costmap ? costmap_colour : map_colour);
  draw_tracks(canvas, record.track);
  draw_eggs(canvas, record);
  return with_legend(canvas.image());
}

cv::Mat draw_map(const OccupancyGrid& map, const std::vector<TrackPoint>& track) {
  Canvas canvas(map, map_colour);
  draw_tracks(canvas, track);
  return canvas.image();
}

}  // namespace coop::demo
