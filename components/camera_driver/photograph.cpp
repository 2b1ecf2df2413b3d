#include "camera_driver/photograph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/config/error.hpp"
#include "core/world/shapes.hpp"

namespace coop::camera_driver {
namespace {

constexpr int kWorkingWidth = 692;   ///< px, to which pictures are scaled
constexpr int kDirections = 48;      ///< of the outline
constexpr double kLeastRough = 1.0;  ///< texture of a picture without any litter, CIE Lab

/// What is asked of the picture, at its working size.
struct Views {
  cv::Mat lab;         ///< CV_32FC3, a little blurred
  cv::Mat texture;     ///< CV_32F: fine detail of brightness, averaged over a neighbourhood
  double rough = 1.0;  ///< texture that a tenth of the picture exceeds
  std::vector<cv::Mat> channels;  ///< CV_8U, in which an egg may be brighter than what is around it
};

cv::Mat stretch(const cv::Mat& values) {
  cv::Mat bytes;
  cv::normalize(values, bytes, 0.0, 255.0, cv::NORM_MINMAX, CV_8U);
  return bytes;
}

double quantile(const cv::Mat& values, double share) {
  std::vector<float> sorted(values.begin<float>(), values.end<float>());
  const auto at =
      sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), at, sorted.end());
  return static_cast<double>(*at);
}

Views look(const cv::Mat& picture, double egg_width) {
  Views views;
  cv::Mat exact;
  picture.convertTo(exact, CV_32FC3, 1.0 / 255.0);
  cv::cvtColor(exact, exact, cv::COLOR_RGB2Lab);
  cv::GaussianBlur(exact, views.lab, {}, 0.05 * egg_width);
  std::vector<cv::Mat> planes;
  cv::split(exact, planes);
  cv::Mat smooth;
  cv::GaussianBlur(planes[0], smooth, {}, 0.08 * egg_width);
  cv::GaussianBlur(cv::abs(planes[0] - smooth), views.texture, {}, 0.10 * egg_width);
  views.rough = std::max(kLeastRough, quantile(views.texture, 0.9));
  cv::split(views.lab, planes);
  views.channels = {stretch(planes[1]), stretch(planes[2]), stretch(planes[0]),
                    stretch(-cv::min(views.texture, views.rough))};
  return views;
}

/// Mean texture well inside, and whether the outline stands off.
class Judge {
 public:
  Judge(const PhotographConfig& config, const Views& views) : config_(config), views_(views) {}

  /// 0 where the ellipse is no egg.
  [[nodiscard]] double score(const Blob& egg) const {
    const double c = std::cos(egg.angle);
    const double s = std::sin(egg.angle);
    const auto at = [&](double radius, int i) {
      const double t = 2.0 * std::numbers::pi * i / kDirections;
      const double x = radius * egg.half_long * std::cos(t);
      const double y = radius * egg.half_short * std::sin(t);
      return cv::Point(static_cast<int>(std::lround(egg.column + c * x - s * y)),
                       static_cast<int>(std::lround(egg.row + s * x + c * y)));
    };
    const cv::Rect picture(0, 0, views_.lab.cols, views_.lab.rows);
    double texture = 0.0;
    int inside = 0;
    std::array<cv::Vec3f, kDirections> steps{};  // of colour over the outline
    cv::Vec3f sum;
    for (int i = 0; i < kDirections; ++i) {
      for (const double radius : {0.2, 0.45, 0.65}) {
        const cv::Point point = at(radius, i);
        if (!picture.contains(point)) continue;
        texture += static_cast<double>(views_.texture.at<float>(point));
        ++inside;
      }
      const cv::Point near = at(0.80, i);
      const cv::Point far = at(1.22, i);
      if (!picture.contains(near) || !picture.contains(far)) continue;
      steps[static_cast<std::size_t>(i)] =
          views_.lab.at<cv::Vec3f>(near) - views_.lab.at<cv::Vec3f>(far);
      sum += steps[static_cast<std::size_t>(i)];
    }
    // All round the step is to one side: darker, redder or whatever the egg is.
    const cv::Vec3f side = sum / std::max(1e-6, cv::norm(sum));
    const auto outline = std::ranges::count_if(steps, [&](const cv::Vec3f& step) {
      return static_cast<double>(step.dot(side)) > config_.min_contrast;
    });
    if (inside == 0) return 0.0;
    const double rough = texture / inside / views_.rough;
    const double stands_off = static_cast<double>(outline) / kDirections;
    if (rough > config_.max_texture || stands_off < config_.min_outline) return 0.0;
    return stands_off * std::min(1.0, egg.fill()) * (1.0 - 0.5 * rough / config_.max_texture);
  }

 private:
  const PhotographConfig& config_;
  const Views& views_;
};

bool has_shape_of_egg(const PhotographConfig& config, const Blob& blob, int width) {
  const double short_axis = 2.0 * blob.half_short / width;
  return !blob.at_border && short_axis >= config.min_width && short_axis <= config.max_width &&
         blob.half_long <= config.max_aspect * blob.half_short && blob.fill() >= config.min_fill;
}

/// The blob, or its parts where it may be several eggs.
std::vector<Blob> pieces(const PhotographConfig& config, const Blob& blob, cv::Mat& labels) {
  const double width = labels.cols;
  const double smallest = std::numbers::pi * 0.25 * std::pow(config.min_width * width, 2);
  if (blob.area < 1.5 * smallest || has_shape_of_egg(config, blob, labels.cols)) return {blob};
  const double core = 0.30 * config.min_width * width;
  std::vector<Blob> parts = split_blob(blob, core, labels, 1 << 20);
  return parts.empty() ? std::vector<Blob>{blob} : parts;
}

void keep_best(std::vector<PhotographedEgg>& eggs) {
  std::ranges::stable_sort(eggs, std::ranges::greater{}, &PhotographedEgg::score);
  std::vector<PhotographedEgg> kept;
  for (const PhotographedEgg& egg : eggs) {
    const bool is_new = std::ranges::none_of(kept, [&](const PhotographedEgg& better) {
      const double apart = std::hypot(egg.ellipse.column - better.ellipse.column,
                                      egg.ellipse.row - better.ellipse.row);
      return apart < 0.6 * (egg.ellipse.half_short + better.ellipse.half_short);
    });
    if (is_new) kept.push_back(egg);
  }
  eggs = std::move(kept);
}

Blob scaled(Blob blob, double factor) {
  blob.column = (blob.column + 0.5) * factor - 0.5;
  blob.row = (blob.row + 0.5) * factor - 0.5;
  blob.half_long *= factor;
  blob.half_short *= factor;
  return blob;
}

}  // namespace

void PhotographConfig::describe(config::Fields& fields) {
  fields.number("min_width", min_width,
                {.unit = "1", .help = "of an egg in the picture's", .min = 0.01, .max = 1});
  fields.number("max_width", max_width,
                {.unit = "1", .help = "of an egg in the picture's", .min = 0.01, .max = 1});
  fields.number("max_aspect", max_aspect,
                {.unit = "1", .help = "long by short axis", .min = 1, .max = 10});
  fields.number("min_fill", min_fill,
                {.unit = "1", .help = "area in the ellipse's", .min = 0, .max = 1});
  fields.number("min_outline", min_outline,
                {.unit = "1", .help = "of the outline that stands off", .min = 0, .max = 1});
  fields.number("max_texture", max_texture,
                {.unit = "1", .help = "inside, of the picture's rough tenth", .min = 0, .max = 10});
  fields.number("min_contrast", min_contrast,
                {.unit = "1", .help = "of colour at the outline, CIE Lab", .min = 0, .max = 100});
  fields.integer("levels", levels,
                 {.unit = "1", .help = "thresholds a channel", .min = 2, .max = 255});
}

void PhotographConfig::validate() const {
  if (min_width >= max_width) throw config::Error("min_width: expected less than max_width");
}

std::vector<PhotographedEgg> find_eggs(const PhotographConfig& config, const cv::Mat& picture) {
  const double scale = static_cast<double>(picture.cols) / kWorkingWidth;
  cv::Mat small;
  cv::resize(picture, small, {kWorkingWidth, static_cast<int>(std::lround(picture.rows / scale))},
             0, 0, cv::INTER_AREA);
  const double egg_width = 0.5 * (config.min_width + config.max_width) * kWorkingWidth;
  const Views views = look(small, egg_width);
  const Judge judge(config, views);
  const int min_area = static_cast<int>(0.6 * std::pow(config.min_width * kWorkingWidth, 2));
  const int max_area = static_cast<int>(12.0 * std::pow(config.max_width * kWorkingWidth, 2));
  std::vector<PhotographedEgg> eggs;
  cv::Mat labels;
  for (const cv::Mat& channel : views.channels) {
    for (int level = 1; level <= config.levels; ++level) {
      const cv::Mat mask = channel > 255.0 * level / (config.levels + 1);
      for (const Blob& blob : find_blobs(mask, min_area, max_area, labels)) {
        for (const Blob& piece : pieces(config, blob, labels)) {
          if (!has_shape_of_egg(config, piece, kWorkingWidth)) continue;
          const double score = judge.score(piece);
          if (score > 0.0) eggs.push_back({piece, score});
        }
      }
    }
  }
  keep_best(eggs);
  for (PhotographedEgg& egg : eggs) egg.ellipse = scaled(egg.ellipse, scale);
  return eggs;
}

Detection to_detection(const PhotographedEgg& egg, const Intrinsics& intrinsics) {
  constexpr double kSizeSpread = 0.15;  // of the width of eggs as seen
  constexpr double kPixels = 2.0;       // deviation of a centre
  const Blob& ellipse = egg.ellipse;
  const double z = intrinsics.fx * world::kEggHalfWidth / ellipse.half_short;
  const Eigen::Vector3d ray = intrinsics.ray(ellipse.column, ellipse.row);
  const Eigen::Vector3d axis = ray.normalized();
  const double along = kSizeSpread * z * ray.norm();
  const double across = kPixels * z / intrinsics.fx;
  Detection detection;
  detection.class_id = "egg";
  detection.score = egg.score;
  detection.position = z * ray;
  detection.covariance = across * across * Eigen::Matrix3d::Identity() +
                         (along * along - across * across) * axis * axis.transpose();
  const double pixel = z / intrinsics.fx;
  const double c = std::cos(ellipse.angle);
  const double s = std::sin(ellipse.angle);
  detection.size << 2.0 * pixel * std::hypot(ellipse.half_long * c, ellipse.half_short * s),
      2.0 * pixel * std::hypot(ellipse.half_long * s, ellipse.half_short * c),
      2.0 * world::kEggHalfWidth;
  return detection;
}

}  // namespace coop::camera_driver
