#include "camera_driver/sensor_noise.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/random.hpp"

namespace coop::camera_driver {
namespace {

constexpr std::size_t kTable = 1 << 16;  ///< deviates
constexpr std::size_t kSmoothEdge = 256;
constexpr double kSmoothWidth = 2.5;  ///< px, of the bell that neighbours share

std::vector<float> draw_white(RandomStream random) {
  std::vector<float> table(kTable);
  for (float& value : table) value = static_cast<float>(random.normal());
  return table;
}

std::vector<float> draw_smooth(RandomStream random) {
  constexpr int kEdge = static_cast<int>(kSmoothEdge);
  constexpr int kMargin = 16;
  cv::Mat field(kEdge, kEdge, CV_32F);
  for (auto it = field.begin<float>(); it != field.end<float>(); ++it) {
    *it = static_cast<float>(random.normal());
  }
  // Wrapped round, so that the square repeats without a seam.
  cv::Mat wide;
  cv::copyMakeBorder(field, wide, kMargin, kMargin, kMargin, kMargin, cv::BORDER_WRAP);
  cv::GaussianBlur(wide, wide, {}, kSmoothWidth);
  field = wide(cv::Rect(kMargin, kMargin, kEdge, kEdge)).clone();
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(field, mean, deviation);
  std::vector<float> table;
  table.reserve(kSmoothEdge * kSmoothEdge);
  for (auto it = field.begin<float>(); it != field.end<float>(); ++it) {
    table.push_back(static_cast<float>((static_cast<double>(*it) - mean[0]) / deviation[0]));
  }
  return table;
}

/// Seeds of neighbouring stamps must not be neighbours in any bit pattern the generator could show.
std::uint64_t seed_of_frame(std::uint64_t seed, Time stamp) {
  return seed ^ (static_cast<std::uint64_t>(to_nanoseconds(stamp)) * 0x9E3779B97F4A7C15ULL);
}

}  // namespace

void SensorNoiseConfig::describe(config::Fields& fields) {
  fields.section("depth", depth);
  fields.number("smooth_share", smooth_share,
                {.unit = "1",
                 .help = "of the depth's variance that neighbouring pixels share",
                 .min = 0,
                 .max = 1});
  fields.number("dropout", dropout,
                {.unit = "1", .help = "share of pixels without depth", .min = 0, .max = 1});
  fields.number("colour", colour,
                {.unit = "1", .help = "deviation of a channel, in 256ths", .min = 0, .max = 30});
}

SensorNoise::SensorNoise(const SensorNoiseConfig& config, double range_min, double range_max,
                         std::uint64_t seed)
    : config_(config),
      range_min_(range_min),
      range_max_(range_max),
      seed_(seed),
      white_(draw_white(RandomStream(seed, "camera/depth"))),
      smooth_(draw_smooth(RandomStream(seed, "camera/smooth_depth"))),
      colour_(kTable),
      lost_(kTable) {
  RandomStream random(seed, "camera/colour");
  for (std::int8_t& value : colour_) {
    value = static_cast<std::int8_t>(
        std::clamp(std::round(random.normal(0.0, config.colour)), -127.0, 127.0));
  }
  RandomStream loss(seed, "camera/dropout");
  for (std::uint8_t& value : lost_) value = loss.uniform() < config.dropout ? 1 : 0;
}

void SensorNoise::apply(const std::vector<float>& exact_depth, Frame& frame) const {
  RandomStream random(seed_of_frame(seed_, frame.stamp), "camera/frame");
  const auto smooth_column = static_cast<std::size_t>(random.below(kSmoothEdge));
  const auto smooth_row = static_cast<std::size_t>(random.below(kSmoothEdge));
  const auto white_part = static_cast<float>(std::sqrt(1.0 - config_.smooth_share));
  const auto smooth_part = static_cast<float>(std::sqrt(config_.smooth_share));
  const auto constant = static_cast<float>(config_.depth.constant);
  const auto quadratic = static_cast<float>(config_.depth.quadratic);
  const auto nearest = static_cast<float>(range_min_);
  const auto farthest = static_cast<float>(range_max_);
  const auto columns = static_cast<std::size_t>(frame.colour.cols);

  for (int row = 0; row < frame.colour.rows; ++row) {
    const auto white_start = static_cast<std::size_t>(random.below(kTable));
    const auto colour_start = static_cast<std::size_t>(random.below(kTable));
    const auto lost_start = static_cast<std::size_t>(random.below(kTable));
    const float* const smooth =
        smooth_.data() + (smooth_row + static_cast<std::size_t>(row)) % kSmoothEdge * kSmoothEdge;
    const float* const exact = exact_depth.data() + static_cast<std::size_t>(row) * columns;
    auto* const depth = frame.depth.ptr<std::uint16_t>(row);
    for (std::size_t i = 0; i < columns; ++i) {
      const float z = exact[i];
      const float deviate = white_part * white_[(white_start + i) % kTable] +
                            smooth_part * smooth[(smooth_column + i) % kSmoothEdge];
      const float measured = z + (constant + quadratic * z * z) * deviate;
      const bool is_lost = lost_[(lost_start + i) % kTable] != 0;
      const bool seen = z > 0.0F && !is_lost && measured >= nearest && measured <= farthest;
      // Positive, so adding a half rounds as lround does, and vectors can do it.
      // NOLINTNEXTLINE(bugprone-incorrect-roundings)
      depth[i] = seen ? static_cast<std::uint16_t>(measured * 1000.0F + 0.5F) : std::uint16_t{0};
    }
    add_to_colour(frame.colour.ptr(row), frame.colour.cols, colour_start);
  }
}

void SensorNoise::apply_to_colour(Frame& frame) const {
  RandomStream random(seed_of_frame(seed_, frame.stamp), "camera/frame");
  for (int row = 0; row < frame.colour.rows; ++row) {
    add_to_colour(frame.colour.ptr(row), frame.colour.cols,
                  static_cast<std::size_t>(random.below(kTable)));
  }
}

void SensorNoise::add_to_colour(std::uint8_t* row, int columns, std::size_t start) const {
  const std::size_t values = 3 * static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < values; ++i) {
    row[i] = static_cast<std::uint8_t>(std::clamp(row[i] + colour_[(start + i) % kTable], 0, 255));
  }
}

}  // namespace coop::camera_driver
