#include "slam/scan_matcher.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace coop::slam {

void ScanMatcherConfig::describe(config::Fields& fields) {
  fields.section("field", field);
  fields.number("likelihood_gain", likelihood_gain,
                {.help = "weight of a beam's log-likelihood", .min = 1e-4, .max = 10.0});
  fields.number("weight_gain", weight_gain,
                {.help = "the same in the weight of a particle", .min = 1e-4, .max = 10.0});
  fields.number("linear_step", linear_step,
                {.unit = "m", .help = "first step of the search", .min = 0.001, .max = 2.0});
  fields.number("angular_step", angular_step,
                {.unit = "rad", .help = "first step of the search", .min = 0.001, .max = 1.0});
  fields.integer("refinements", refinements,
                 {.help = "times the steps are halved", .min = 0, .max = 12});
  fields.number("poor_match", poor_match,
                {.help = "mean log-likelihood a beam below which the wide search starts",
                 .min = -10.0,
                 .max = 0.0});
  fields.number(
      "wide_position", wide_position,
      {.unit = "m", .help = "reach of the wide search to each side", .min = 0.0, .max = 5.0});
  fields.number(
      "wide_yaw", wide_yaw,
      {.unit = "rad", .help = "reach of the wide search to each side", .min = 0.0, .max = 3.2});
  fields.number("search_margin", search_margin,
                {.unit = "m", .help = "of the field beyond the scan", .min = 0.1, .max = 10.0});
  fields.number("sample_spread", sample_spread,
                {.help = "deviations between samples around the maximum", .min = 0.1, .max = 5.0});
}

Proposal ScanMatcher::match(const TileMap& map, const ScanPoints& points,
                            const Pose2& predicted_base_in_map,
                            const Eigen::Vector3d& odometry_stddev) {
  Proposal proposal;
  prior_information_ = odometry_stddev.array().square().inverse();
  prepare(map, points, predicted_base_in_map);
  if (points.empty() || field_.wall_cells() == 0) {
    proposal.covariance = odometry_stddev.array().square().matrix().asDiagonal();
    return proposal;
  }
  Eigen::Vector3d mode = climb(Eigen::Vector3d::Zero());
  const auto beams = static_cast<double>(points_.size());
  if (likelihood(mode) < config_.poor_match * beams) mode = search_wide(mode);
  proposal.matched = true;
  proposal.mean_likelihood = likelihood(mode) / beams;
  sample_around(mode, information_at(mode), proposal);
  return proposal;
}

void ScanMatcher::prepare(const TileMap& map, const ScanPoints& points, const Pose2& predicted) {
  predicted_ = predicted;
  inverse_resolution_ = 1.0 / map.resolution();
  const auto scale = static_cast<float>(inverse_resolution_);
  points_.resize(points.match.size());
  std::ranges::transform(points.match, points_.begin(), [scale](const Eigen::Vector2f& point) {
    return Eigen::Vector2f(scale * point);
  });
  Eigen::Vector2d low = predicted.position();
  Eigen::Vector2d high = low;
  for (const auto& point : points.match) {
    const Eigen::Vector2d in_map = predicted * Eigen::Vector2d(point.cast<double>());
    low = low.cwiseMin(in_map);
    high = high.cwiseMax(in_map);
  }
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(config_.search_margin);
  field_.build(map, map.cell_of(low - margin), map.cell_of(high + margin));
}

double ScanMatcher::likelihood(const Eigen::Vector3d& deviation, std::size_t stride) const {
  const Pose2 pose = predicted_ * Pose2{deviation.x(), deviation.y(), deviation.z()};
  const auto c = static_cast<float>(std::cos(pose.yaw));
  const auto s = static_cast<float>(std::sin(pose.yaw));
  const auto x = static_cast<float>(pose.x * inverse_resolution_);
  const auto y = static_cast<float>(pose.y * inverse_resolution_);
  float sum = 0.0F;
  for (std::size_t i = 0; i < points_.size(); i += stride) {
    const Eigen::Vector2f& point = points_[i];
    sum += field_.at(x + c * point.x() - s * point.y(), y + s * point.x() + c * point.y());
  }
  return static_cast<double>(sum);
}

double ScanMatcher::objective(const Eigen::Vector3d& deviation) const {
  const double prior = -0.5 * deviation.cwiseAbs2().dot(prior_information_);
  return config_.likelihood_gain * likelihood(deviation) + prior;
}

Eigen::Vector3d ScanMatcher::climb(const Eigen::Vector3d& start) const {
  Eigen::Vector3d best = start;
  double best_value = objective(best);
  Eigen::Vector3d step{config_.linear_step, config_.linear_step, config_.angular_step};
  for (int level = 0; level <= config_.refinements; ++level, step *= 0.5) {
    bool improved = true;
    while (improved) {
      improved = false;
      Eigen::Vector3d candidate_best = best;
      for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
          Eigen::Vector3d candidate = best;
          candidate[axis] += sign * step[axis];
          const double value = objective(candidate);
          if (value > best_value) {
            best_value = value;
            candidate_best = candidate;
            improved = true;
          }
        }
      }
      best = candidate_best;
    }
  }
  return best;
}

/// Where odometry misled the climb: the best of a lattice of poses, seen with few beams, are starts
/// of climbs of their own.
Eigen::Vector3d ScanMatcher::search_wide(const Eigen::Vector3d& mode) const {
  constexpr double kLinearStep = 0.15;   // m, within the basin of a wall in the field
  constexpr double kAngularStep = 0.06;  // rad, the same at a few metres
  constexpr std::size_t kStarts = 4;
  struct Start {
    double value;
    Eigen::Vector3d deviation;
  };
  const std::size_t stride = std::max<std::size_t>(1, points_.size() / 60);
  const int side = static_cast<int>(config_.wide_position / kLinearStep);
  const int turns = static_cast<int>(config_.wide_yaw / kAngularStep);
  std::array<Start, kStarts> starts;
  starts.fill({-std::numeric_limits<double>::infinity(), mode});
  for (int turn = -turns; turn <= turns; ++turn) {
    for (int x = -side; x <= side; ++x) {
      for (int y = -side; y <= side; ++y) {
        const Eigen::Vector3d deviation{x * kLinearStep, y * kLinearStep, turn * kAngularStep};
        const double prior = -0.5 * deviation.cwiseAbs2().dot(prior_information_);
        const double value =
            config_.likelihood_gain * static_cast<double>(stride) * likelihood(deviation, stride) +
            prior;
        if (value <= starts.back().value) continue;
        starts.back() = {value, deviation};
        std::ranges::sort(starts, std::greater{}, &Start::value);
      }
    }
  }
  Eigen::Vector3d best = mode;
  double best_value = objective(mode);
  for (const Start& start : starts) {
    const Eigen::Vector3d candidate = climb(start.deviation);
    const double value = objective(candidate);
    if (value > best_value) {
      best_value = value;
      best = candidate;
    }
  }
  return best;
}

/// Curvature by central differences over about the width of the maximum.
Eigen::Matrix3d ScanMatcher::information_at(const Eigen::Vector3d& mode) const {
  const Eigen::Vector3d step{0.02, 0.02, 0.008};
  const double center = objective(mode);
  Eigen::Matrix3d information;
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d delta = Eigen::Vector3d::Zero();
    delta[i] = step[i];
    information(i, i) =
        -(objective(mode + delta) - 2.0 * center + objective(mode - delta)) / (step[i] * step[i]);
    for (int j = 0; j < i; ++j) {
      Eigen::Vector3d other = Eigen::Vector3d::Zero();
      other[j] = step[j];
      const double mixed = objective(mode + delta + other) - objective(mode + delta - other) -
                           objective(mode - delta + other) + objective(mode - delta - other);
      information(i, j) = information(j, i) = -mixed / (4.0 * step[i] * step[j]);
    }
  }
  return information;
}

void ScanMatcher::sample_around(const Eigen::Vector3d& mode, const Eigen::Matrix3d& information,
                                Proposal& proposal) const {
  // Where the field is flat or noisy the curvature may be negative: then odometry's deviation is
  // the scale.
  const Eigen::Matrix3d prior = prior_information_.asDiagonal();
  const Eigen::Vector3d whiten = prior_information_.cwiseSqrt().cwiseInverse();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(whiten.asDiagonal() * information *
                                                        whiten.asDiagonal());
  const Eigen::Vector3d spread = solver.eigenvalues().cwiseMax(0.5).cwiseSqrt().cwiseInverse();
  const Eigen::Matrix3d axes = whiten.asDiagonal() * solver.eigenvectors() * spread.asDiagonal();

  constexpr int kSide = 3;
  constexpr int kCount = kSide * kSide * kSide;
  std::array<Eigen::Vector3d, kCount> samples;
  std::array<double, kCount> logs{};
  double largest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector3d lattice{static_cast<double>(i % 3 - 1),
                                  static_cast<double>(i / 3 % 3 - 1),
                                  static_cast<double>(i / 9 - 1)};
    samples[static_cast<std::size_t>(i)] = mode + config_.sample_spread * (axes * lattice);
    logs[static_cast<std::size_t>(i)] = objective(samples[static_cast<std::size_t>(i)]);
    largest = std::max(largest, logs[static_cast<std::size_t>(i)]);
  }
  double sum = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < kCount; ++i) {
    const double weight = std::exp(logs[i] - largest);
    sum += weight;
    mean += weight * samples[i];
  }
  mean /= sum;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < kCount; ++i) {
    const Eigen::Vector3d d = samples[i] - mean;
    covariance += std::exp(logs[i] - largest) / sum * d * d.transpose();
  }
  proposal.mean = mean;
  proposal.covariance = covariance;
  const double volume = std::abs(axes.determinant()) * std::pow(config_.sample_spread, 3);
  const double prior_norm = 0.5 * std::log(prior.determinant());
  proposal.log_evidence = config_.weight_gain / config_.likelihood_gain *
                          (largest + std::log(sum) + std::log(volume) + prior_norm);
}

}  // namespace coop::slam
