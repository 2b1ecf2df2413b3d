#include "amcl/amcl.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/config/error.hpp"

namespace coop::amcl {
namespace {

std::size_t most_particles(const AmclConfig& config) {
  return static_cast<std::size_t>(std::max(config.kld.max_particles, config.scattered_particles));
}

}  // namespace

Amcl::Amcl(const AmclConfig& config, const OccupancyGrid& map, std::uint64_t seed)
    : config_(config),
      field_(config.field, map),
      free_space_(map),
      motion_model_(config.motion),
      resampler_(config.kld),
      clusters_(config.kld.bin_size, config.kld.yaw_bin_size, most_particles(config)),
      recovery_(config.recovery),
      random_(seed, "amcl") {
  for (ParticleSet* set : {&particles_, &resampled_}) set->reserve(most_particles(config));
  fresh_.reserve(static_cast<std::size_t>(config.recovery_candidates));
  scores_.reserve(most_particles(config));
}

void Amcl::set_pose(const PoseEstimate& robot_in_map) {
  // LDLT copes with a covariance that is singular or a little indefinite.
  const Eigen::LDLT<Eigen::Matrix3d> decomposed(robot_in_map.covariance);
  const Eigen::Vector3d scale = decomposed.vectorD().cwiseMax(0.0).cwiseSqrt();
  const Eigen::Matrix3d lower = decomposed.matrixL();
  const int count = std::max(config_.kld.min_particles, config_.kld.max_particles / 10);
  particles_.clear();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d unit{random_.normal(), random_.normal(), random_.normal()};
    const Eigen::Vector3d offset =
        decomposed.transpositionsP().transpose() * (lower * scale.cwiseProduct(unit)).eval();
    particles_.push_back({robot_in_map.pose.x + offset.x(), robot_in_map.pose.y + offset.y(),
                          normalize_angle(robot_in_map.pose.yaw + offset.z())},
                         1.0F / static_cast<float>(count));
  }
  estimate_ = {};
  recovery_.reset();
  settling_ = config_.standing_updates;
}

bool Amcl::scatter() {
  if (free_space_.empty()) return false;
  const int count = config_.scattered_particles;
  particles_.clear();
  for (int i = 0; i < count; ++i) {
    particles_.push_back(free_space_.draw(random_), 1.0F / static_cast<float>(count));
  }
  estimate_ = {};
  recovery_.reset();
  settling_ = config_.standing_updates;
  return true;
}

std::optional<Pose2> Amcl::motion_since_update(Time stamp, const Pose2& base_in_odom) {
  if (last_odometry_) {
    const double elapsed = to_seconds(stamp - last_odometry_->stamp);
    if (elapsed <= 0.0 && elapsed > -1.0) return std::nullopt;
    const Pose2 step = last_odometry_->pose.inverse() * base_in_odom;
    const double farthest = config_.plausible_speed * (std::max(0.0, elapsed) + 0.1);
    const bool restarted =
        elapsed < 0.0 || std::hypot(step.x, step.y) > farthest || std::abs(step.yaw) > farthest;
    if (restarted) base_in_odom_at_update_.reset();
  }
  last_odometry_ = StampedPose2{stamp, base_in_odom};
  if (!base_in_odom_at_update_) {
    base_in_odom_at_update_ = base_in_odom;
    settling_ = std::max(settling_, 1);
  }
  return base_in_odom_at_update_->inverse() * base_in_odom;
}

void Amcl::predict(const Pose2& motion) {
  motion_model_.apply(particles_, motion, random_);
  // A pose just found stands on few particles, often copies of one: their noise fades out slowly.
  const double open = estimate_.localised
                          ? static_cast<double>(settling_) / std::max(1, config_.settle_updates)
                          : 1.0;
  const double noise = open * config_.search_noise;
  if (noise <= 0.0) return;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const double yaw = static_cast<double>(particles_.yaw[i]);
    particles_.x[i] += static_cast<float>(random_.normal(0.0, noise));
    particles_.y[i] += static_cast<float>(random_.normal(0.0, noise));
    particles_.yaw[i] = static_cast<float>(normalize_angle(yaw + random_.normal(0.0, noise)));
  }
}

bool Amcl::weigh(const LaserScan& scan, const Pose2& laser_in_base) {
  select_beams(scan, laser_in_base, config_.beams, config_.max_range, updates_, ends_);
  if (ends_.size() < static_cast<std::size_t>(config_.min_beams)) return false;
  field_.score(particles_, ends_, scores_);

  double fit = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    fit += static_cast<double>(particles_.weight[i] * std::exp(scores_[i]));
    total += static_cast<double>(particles_.weight[i]);
  }
  temper(particles_.weight);
  estimate_.fit = fit / total;
  // What fitted before the pose was found says nothing about how well scans fit there.
  estimate_.random_share =
      estimate_.localised ? recovery_.update(estimate_.fit) : config_.searching_share;
  if (free_space_.empty()) estimate_.random_share = 0.0;
  return true;
}

void Amcl::temper(std::vector<float>& weights) {
  const float best = *std::max_element(scores_.begin(), scores_.end());
  const double beams = estimate_.localised ? config_.independent_beams : config_.searching_beams;
  const auto worth = static_cast<float>(std::min(static_cast<double>(ends_.size()), beams));
  double total = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] *= std::exp(worth * (scores_[i] - best));
    total += static_cast<double>(weights[i]);
  }
  const auto scale = static_cast<float>(1.0 / total);
  for (float& weight : weights) weight *= scale;
}

void Amcl::draw_fresh() {
  fresh_.clear();
  for (int i = 0; i < config_.recovery_candidates; ++i) {
    fresh_.push_back(free_space_.draw(random_), 1.0F);
  }
  field_.score(fresh_, ends_, scores_);
  temper(fresh_.weight);
}

void Amcl::settle(const Cluster& cluster) {
  const double spread = position_stddev(cluster.pose);
  const bool was_localised = estimate_.localised;
  const double spread_limit = was_localised ? config_.lost_stddev : config_.localised_stddev;
  const double share_limit = config_.localised_share * (was_localised ? 0.5 : 1.0);
  estimate_.localised = spread < spread_limit && cluster.share > share_limit;
  if (estimate_.localised != was_localised) {
    settling_ = estimate_.localised ? config_.settle_updates : config_.standing_updates;
    recovery_.reset();
  }
  estimate_.robot_in_map = cluster.pose;
  estimate_.cluster_share = cluster.share;
}

void Amcl::resample(const Cluster& cluster) {
  double sum_of_squares = 0.0;
  for (const float weight : particles_.weight) {
    sum_of_squares += static_cast<double>(weight) * static_cast<double>(weight);
  }
  const auto count = static_cast<double>(particles_.size());
  const double needed = std::clamp(
      static_cast<double>(kld_bound(cluster.bins, config_.kld.error, config_.kld.quantile)),
      static_cast<double>(config_.kld.min_particles),
      static_cast<double>(config_.kld.max_particles));
  const bool uneven = 1.0 / sum_of_squares < config_.resample_share * count;
  const bool wrong_number = count > 1.5 * needed || count < needed / 1.5;
  if (!uneven && !wrong_number && estimate_.random_share <= 0.0) return;
  if (estimate_.random_share > 0.0) draw_fresh();
  resampler_.resample(particles_, estimate_.random_share, fresh_, random_, resampled_);
  std::swap(particles_, resampled_);
}

std::optional<Estimate> Amcl::update(const LaserScan& scan, const Pose2& laser_in_base,
                                     const Pose2& base_in_odom) {
  if (particles_.empty()) return std::nullopt;
  const auto motion = motion_since_update(scan.stamp, base_in_odom);
  if (!motion) return std::nullopt;

  const bool moved = std::hypot(motion->x, motion->y) >= config_.update_distance ||
                     std::abs(motion->yaw) >= config_.update_angle;
  estimate_.stamp = scan.stamp;
  estimate_.updated = moved || settling_ > 0;
  if (estimate_.updated) {
    predict(*motion);
    base_in_odom_at_update_ = base_in_odom;
    const bool weighed = weigh(scan, laser_in_base);
    const Cluster cluster = clusters_.heaviest(particles_);
    if (weighed && settling_ > 0) --settling_;
    settle(cluster);
    if (weighed) {
      resample(cluster);
      ++updates_;
    }
    estimate_.odom_in_map = estimate_.robot_in_map.pose * base_in_odom.inverse();
    estimate_.particles = particles_.size();
  } else {
    estimate_.robot_in_map.pose = estimate_.odom_in_map * base_in_odom;
  }
  return estimate_;
}

void AmclConfig::describe(config::Fields& fields) {
  fields.number(
      "update_distance", update_distance,
      {.unit = "m", .help = "driven until the next scan is weighed in", .min = 0, .max = 5});
  fields.number(
      "update_angle", update_angle,
      {.unit = "rad", .help = "turned until the next scan is weighed in", .min = 0, .max = 3});
  fields.integer("beams", beams, {.help = "of a scan, at most", .min = 4, .max = 10000});
  fields.number("max_range", max_range,
                {.unit = "m", .help = "longer beams are not used", .min = 0.5, .max = 500});
  fields.integer("min_beams", min_beams,
                 {.help = "fewer usable beams say nothing", .min = 1, .max = 10000});
  fields.number("independent_beams", independent_beams,
                {.help = "so many independent beams a scan is worth", .min = 0.5, .max = 10000});
  fields.number("searching_beams", searching_beams,
                {.help = "the same while the pose is open", .min = 0.5, .max = 10000});
  fields.number("resample_share", resample_share,
                {.help = "resample below this share of effective particles", .min = 0, .max = 1});
  fields.number(
      "localised_stddev", localised_stddev,
      {.unit = "m", .help = "the pose is known from this spread on", .min = 0.01, .max = 10});
  fields.number("lost_stddev", lost_stddev,
                {.unit = "m",
                 .help = "the pose is no longer known from this spread on",
                 .min = 0.01,
                 .max = 20});
  fields.number("localised_share", localised_share,
                {.help = "weight the heaviest cluster must hold", .min = 0, .max = 1});
  fields.number("search_noise", search_noise,
                {.unit = "m, rad",
                 .help = "spread added an update while the pose is not known",
                 .min = 0,
                 .max = 1});
  fields.integer("settle_updates", settle_updates,
                 {.help = "scans weighed in after the pose was found, even if the robot stands",
                  .min = 0,
                  .max = 1000});
  fields.number("searching_share", searching_share,
                {.help = "of the particles drawn anew at each update while the pose is open",
                 .min = 0,
                 .max = 0.9});
  fields.integer("standing_updates", standing_updates,
                 {.help = "scans weighed in while the pose is open and the robot stands",
                  .min = 1,
                  .max = 1000});
  fields.integer("scattered_particles", scattered_particles,
                 {.help = "spread over free space for global localisation", .min = 10, .max = 1e7});
  fields.integer(
      "recovery_candidates", recovery_candidates,
      {.help = "poses tried against a scan to draw recovery particles from", .min = 1, .max = 1e7});
  fields.number(
      "plausible_speed", plausible_speed,
      {.unit = "m/s, rad/s", .help = "faster odometry has been restarted", .min = 0.1, .max = 100});
  fields.section("motion", motion);
  fields.section("field", field);
  fields.section("kld", kld);
  fields.section("recovery", recovery);
}

void AmclConfig::validate() const {
  kld.validate();
  if (lost_stddev <= localised_stddev) {
    throw config::Error("lost_stddev must be above localised_stddev");
  }
}

}  // namespace coop::amcl
