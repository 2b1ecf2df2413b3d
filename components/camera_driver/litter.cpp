#include "camera_driver/litter.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/random.hpp"

namespace coop::camera_driver {
namespace {

/// What lies on the ground, drawn as ellipses.
struct Scraps {
  int per_square_metre;
  double length_min, length_max;  ///< m
  double width_min, width_max;    ///< m
  Colour dark, pale;
};

constexpr std::array<Scraps, 6> kScraps{{
    {700, 0.02, 0.09, 0.003, 0.006, {120, 92, 56}, {206, 178, 122}},     // straw
    {500, 0.010, 0.028, 0.006, 0.014, {150, 118, 76}, {214, 186, 138}},  // shavings
    {250, 0.010, 0.030, 0.006, 0.020, {62, 46, 30}, {96, 72, 46}},       // dark crumbs
    {12, 0.008, 0.018, 0.006, 0.014, {176, 170, 152}, {214, 210, 198}},  // droppings
    {40, 0.004, 0.008, 0.003, 0.005, {210, 206, 196}, {240, 238, 232}},  // down
    {1, 0.028, 0.060, 0.024, 0.045, {196, 190, 176}, {232, 230, 222}},   // pale patches, flat
}};

Colour blend(const Colour& a, const Colour& b, double ratio) {
  Colour result{};
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = static_cast<std::uint8_t>(a[i] + ratio * (b[i] - a[i]));
  }
  return result;
}

/// Ground whose brightness wanders at three scales.
cv::Mat draw_ground(int cells, RandomStream& random) {
  cv::Mat brightness(cells, cells, CV_32F, cv::Scalar(1.0));
  for (const int scale : {4, 32, 256}) {
    cv::Mat coarse(cells / scale, cells / scale, CV_32F);
    for (auto it = coarse.begin<float>(); it != coarse.end<float>(); ++it) {
      *it = static_cast<float>(random.uniform(-0.13, 0.13));
    }
    cv::Mat fine;
    cv::resize(coarse, fine, brightness.size(), 0, 0, cv::INTER_LINEAR);
    brightness += fine;
  }
  cv::Mat ground(cells, cells, CV_8UC3);
  for (int i = 0; i < cells * cells; ++i) {
    const float b = brightness.at<float>(i / cells, i % cells);
    ground.at<cv::Vec3b>(i / cells, i % cells) = {cv::saturate_cast<uchar>(128.0F * b),
                                                  cv::saturate_cast<uchar>(100.0F * b),
                                                  cv::saturate_cast<uchar>(66.0F * b)};
  }
  return ground;
}

void scatter(const Scraps& scraps, double cell, cv::Mat& ground, RandomStream& random) {
  const double period = ground.cols * cell;
  const int count = static_cast<int>(scraps.per_square_metre * period * period);
  for (int i = 0; i < count; ++i) {
    const cv::Point2d center(random.uniform(0, ground.cols), random.uniform(0, ground.rows));
    const double length = random.uniform(scraps.length_min, scraps.length_max);
    const double width = random.uniform(scraps.width_min, scraps.width_max);
    const double angle = random.uniform(0.0, 180.0);
    const Colour colour = blend(scraps.dark, scraps.pale, random.uniform());
    const cv::RotatedRect outline(center, cv::Size2d(length / cell, width / cell),
                                  static_cast<float>(angle));
    cv::ellipse(ground, outline, cv::Scalar(colour[0], colour[1], colour[2]), cv::FILLED);
  }
}

}  // namespace

Litter::Litter(std::uint64_t seed) {
  RandomStream random(seed, "camera/litter");
  cv::Mat ground = draw_ground(static_cast<int>(kCells), random);
  for (const Scraps& scraps : kScraps) scatter(scraps, kCell, ground, random);
  for (auto& level : levels_) {
    level.resize(static_cast<std::size_t>(ground.total()));
    std::copy_n(ground.ptr(), 3 * ground.total(), level.front().data());
    cv::Mat half;
    cv::resize(ground, half, {}, 0.5, 0.5, cv::INTER_AREA);
    ground = half;
  }
}

int Litter::level_of(double size) {
  return std::clamp(static_cast<int>(std::lround(std::log2(size / kCell))), 0, kLevels - 1);
}

}  // namespace coop::camera_driver
