#include "demo/picture.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "demo/canvas.hpp"

namespace coop::demo {
namespace {

const cv::Scalar kPurple(160, 32, 128);
const cv::Scalar kLightBlue(235, 206, 135);
const cv::Scalar kFreeColour(240, 240, 240);
const cv::Scalar kUnknownColour(170, 170, 170);

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

void draw_eggs(Canvas& canvas, const Record& record) {
  for (const TargetRecord& egg : record.targets) {
    const cv::Point at = canvas.pixel(egg.place_in_map);
    const bool picked = is_done(egg);
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
  Legend legend(image, 900);
  legend.entry(kPurple, "obstacle");
  legend.entry(kLightBlue, "inscribed");
  legend.entry(restricted_colour(80), "restricted");
  legend.entry(kFreeColour, "free");
  legend.entry(kUnknownColour, "unknown");
  legend.entry(kTruthColour, "driven");
  legend.entry(kEstimateColour, "estimated");
  legend.entry(kWhite, "egg, number = order");
  return legend.image();
}

}  // namespace

cv::Mat draw_run(const Record& record) {
  const bool has_costmap = !record.costmap.cells.empty();
  Canvas canvas(has_costmap ? record.costmap : record.map,
                has_costmap ? costmap_colour : map_colour, kPixelsPerMetre);
  canvas.tracks(record.track);
  draw_eggs(canvas, record);
  return with_legend(canvas.image());
}

cv::Mat draw_map(const OccupancyGrid& map, const std::vector<TrackPoint>& track) {
  Canvas canvas(map, map_colour, kPixelsPerMetre);
  canvas.tracks(track);
  return canvas.image();
}

}  // namespace coop::demo
