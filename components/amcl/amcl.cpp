#include "amcl/amcl.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace coop::amcl {
namespace {

constexpr double kRenewed = 0.3;  // of the particles, at each scan of a standing search
constexpr int kAnnealed = 1000;   // candidates that it refines
constexpr int kAnnealingSteps = 12;
constexpr int kConfirmations = 5;   // scans on end that must say the same
constexpr double kSamePlace = 0.3;  // m

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
  proposed_.reserve(most_particles(config));
  annealed_.reserve(kAnnealed);
  for (auto* scores : {&scores_, &proposed_scores_}) scores->reserve(most_particles(config));
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
  begin_search();
}

bool Amcl::scatter() {
  if (free_space_.empty()) return false;
  const int count = config_.scattered_particles;
  particles_.clear();
  for (int i = 0; i < count; ++i) {
    particles_.push_back(free_space_.draw(random_), 1.0F / static_cast<float>(count));
  }
  begin_search();
  return true;
}

void Amcl::begin_search() {
  knows_one_place_ = true;
  estimate_ = {};
  recovery_.reset();
  mean_fit_ = 0.0;
  confirmed_ = 0;
  settling_ = config_.standing_updates;
}

std::optional<Pose2> Amcl::motion_since_update(Time stamp, const OdometryFix& odometry) {
  if (last_stamp_) {
    const double elapsed = to_seconds(stamp - *last_stamp_);
    if (elapsed <= 0.0 && elapsed > -1.0) return std::nullopt;
    if (elapsed < 0.0) base_in_odom_at_update_.reset();  // the clock was set back
    if (odometry.piece != piece_) {
      spread(config_.restart_stddev, config_.restart_yaw_stddev);
      settling_ = std::max(settling_, config_.settle_updates);
    }
  }
  last_stamp_ = stamp;
  piece_ = odometry.piece;
  if (!base_in_odom_at_update_) {
    base_in_odom_at_update_ = odometry.base_in_odom;
    settling_ = std::max(settling_, 1);
  }
  return base_in_odom_at_update_->inverse() * odometry.base_in_odom;
}

void Amcl::predict(const Pose2& motion) {
  motion_model_.apply(particles_, motion, random_);
  // A pose just found stands on few particles, often copies of one: their noise fades out slowly.
  const double open = estimate_.localised
                          ? static_cast<double>(settling_) / std::max(1, config_.settle_updates)
                          : 1.0;
  spread(open * config_.search_noise, open * config_.search_noise);
}

void Amcl::spread(double position, double yaw) {
  if (position <= 0.0 && yaw <= 0.0) return;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const double turned = static_cast<double>(particles_.yaw[i]);
    particles_.x[i] += static_cast<float>(random_.normal(0.0, position));
    particles_.y[i] += static_cast<float>(random_.normal(0.0, position));
    particles_.yaw[i] = static_cast<float>(normalize_angle(turned + random_.normal(0.0, yaw)));
  }
}

bool Amcl::choose_beams(const LaserScan& scan, const Pose2& laser_in_base) {
  select_beams(scan, laser_in_base, config_.beams, config_.max_range, updates_, ends_);
  return ends_.size() >= static_cast<std::size_t>(config_.min_beams);
}

void Amcl::weigh() {
  field_.score(particles_, ends_, scores_);
  estimate_.fit = mean_fit();
  temper(particles_.weight, tracking_beams());
  // What fitted before the pose was found says nothing about how well scans fit there.
  estimate_.random_share =
      estimate_.localised ? recovery_.update(estimate_.fit) : config_.searching_share;
  if (free_space_.empty()) estimate_.random_share = 0.0;
}

double Amcl::tracking_beams() const {
  return estimate_.localised ? config_.independent_beams : config_.searching_beams;
}

void Amcl::temper(std::vector<float>& weights, double beams) {
  const float best = *std::max_element(scores_.begin(), scores_.end());
  const auto worth = static_cast<float>(std::min(static_cast<double>(ends_.size()), beams));
  double total = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] *= std::exp(worth * (scores_[i] - best));
    total += static_cast<double>(weights[i]);
  }
  const auto scale = static_cast<float>(1.0 / total);
  for (float& weight : weights) weight *= scale;
}

void Amcl::draw_fresh(double beams) {
  fresh_.clear();
  for (int i = 0; i < config_.recovery_candidates; ++i) {
    fresh_.push_back(free_space_.draw(random_), 1.0F);
  }
  field_.score(fresh_, ends_, scores_);
  temper(fresh_.weight, beams);
}

/// Mean over the last scans of how well the particles fit, as they are weighed now; while the pose
/// is open the scan at hand alone counts, for the particles were elsewhere before.
void Amcl::watch_fit() {
  const double fit = mean_fit();
  if (mean_fit_ <= 0.0 || !estimate_.localised) mean_fit_ = fit;
  mean_fit_ += config_.fit_rate * (fit - mean_fit_);
}

/// Of the scores at hand.
double Amcl::mean_fit() const {
  double fit = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    fit += static_cast<double>(particles_.weight[i] * std::exp(scores_[i]));
    total += static_cast<double>(particles_.weight[i]);
  }
  return fit / total;
}

void Amcl::settle(const Cluster& cluster, bool confirmed) {
  const double spread = position_stddev(cluster.pose);
  const bool was_localised = estimate_.localised;
  const double spread_limit = was_localised ? config_.lost_stddev : config_.localised_stddev;
  const double share_limit = config_.localised_share * (was_localised ? 0.5 : 1.0);
  const double fit_limit = config_.lost_fit * (was_localised ? 1.0 : 2.0);
  const bool one_place = spread < spread_limit && cluster.share > share_limit && confirmed;
  estimate_.doubt = mean_fit_ < fit_limit ? Doubt::kMisfit
                    : one_place           ? Doubt::kNone
                                          : Doubt::kSeveralPlaces;
  estimate_.localised = estimate_.doubt == Doubt::kNone;
  // What was believed on the way here is contradicted.
  if (estimate_.doubt == Doubt::kMisfit) knows_one_place_ = true;
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
  if (estimate_.random_share > 0.0) draw_fresh(tracking_beams());
  resampler_.resample(particles_, estimate_.random_share, fresh_, random_, resampled_);
  std::swap(particles_, resampled_);
}

void Amcl::weigh_in(const LaserScan& scan, const Pose2& laser_in_base, const Pose2& motion) {
  predict(motion);
  const bool weighed = choose_beams(scan, laser_in_base);
  if (weighed) {
    weigh();
    watch_fit();
    if (settling_ > 0) --settling_;
  }
  const Cluster cluster = clusters_.heaviest(particles_);
  settle(cluster);
  if (!weighed) return;
  resample(cluster);
  ++updates_;
}

/// One Metropolis step of every particle of the set, which leaves likelihood^beams as it is;
/// scores_ are those of the set before and after.
void Amcl::jiggle(ParticleSet& set, double noise, double beams) {
  proposed_ = set;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double yaw = static_cast<double>(set.yaw[i]) + random_.normal(0.0, noise);
    proposed_.x[i] += static_cast<float>(random_.normal(0.0, noise));
    proposed_.y[i] += static_cast<float>(random_.normal(0.0, noise));
    proposed_.yaw[i] = static_cast<float>(normalize_angle(yaw));
  }
  field_.score(proposed_, ends_, proposed_scores_);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double gain = beams * static_cast<double>(proposed_scores_[i] - scores_[i]);
    if (gain < 0.0 && random_.uniform() >= std::exp(gain)) continue;
    set.copy_pose(i, proposed_);
    scores_[i] = proposed_scores_[i];
  }
}

/// Candidates from all over the map: chosen mildly by the scan, so that no place that it could be
/// is missed, moved to where they fit best nearby, and only then weighed sharply.
void Amcl::draw_annealed(double beams) {
  draw_fresh(config_.searching_beams);
  annealed_.clear();
  double cumulative = 0.0;
  std::size_t next = 0;
  const double offset = random_.uniform();
  for (int j = 0; j < kAnnealed; ++j) {
    const double target = (j + offset) / kAnnealed;
    while (next + 1 < fresh_.size() &&
           cumulative + static_cast<double>(fresh_.weight[next]) < target) {
      cumulative += static_cast<double>(fresh_.weight[next++]);
    }
    annealed_.push_back(fresh_.pose(next), 1.0F);
  }
  field_.score(annealed_, ends_, scores_);
  for (int i = 0; i < kAnnealingSteps; ++i) {
    const double part = static_cast<double>(i + 1) / kAnnealingSteps;
    jiggle(annealed_, 0.15 * (1.0 - part) + 0.02, part * beams);
  }
  temper(annealed_.weight, beams - config_.searching_beams);
}

/// A step of the particles towards what the scans from this place say; see the class.
void Amcl::search_standing() {
  const double beams = std::min(static_cast<double>(ends_.size()), config_.standing_beams);
  field_.score(particles_, ends_, scores_);
  jiggle(particles_, config_.search_noise, beams);
  watch_fit();
  // One scan may favour one of two places that look alike by its noise, several do not.
  const Cluster cluster = clusters_.heaviest(particles_);
  const bool same_place = distance(cluster.pose.pose, estimate_.robot_in_map.pose) < kSamePlace;
  confirmed_ = same_place && cluster.share > config_.localised_share ? confirmed_ + 1 : 0;
  settle(cluster, confirmed_ >= kConfirmations);
  if (!free_space_.empty() && !estimate_.localised) {
    draw_annealed(beams);
    resampler_.resample(particles_, kRenewed, annealed_, random_, resampled_);
    std::swap(particles_, resampled_);
  }
  ++updates_;
}

std::optional<Estimate> Amcl::update(const LaserScan& scan, const Pose2& laser_in_base,
                                     const OdometryFix& odometry) {
  if (particles_.empty()) return std::nullopt;
  const auto motion = motion_since_update(scan.stamp, odometry);
  if (!motion) return std::nullopt;
  const Pose2& base_in_odom = odometry.base_in_odom;
  const bool moved = std::hypot(motion->x, motion->y) >= config_.update_distance ||
                     std::abs(motion->yaw) >= config_.update_angle;
  estimate_.stamp = scan.stamp;
  estimate_.updated = true;
  if (moved || settling_ > 0) {
    knows_one_place_ = knows_one_place_ && !moved;
    weigh_in(scan, laser_in_base, *motion);
    base_in_odom_at_update_ = base_in_odom;
  } else if (!choose_beams(scan, laser_in_base)) {
    estimate_.updated = false;
  } else if (knows_one_place_ && !estimate_.localised) {
    search_standing();
  } else if (!estimate_.localised) {
    estimate_.updated = false;  // what was seen on the way must not be forgotten
  } else {
    field_.score(particles_, ends_, scores_);
    watch_fit();
    estimate_.updated = mean_fit_ < config_.lost_fit;
    if (estimate_.updated) settle(clusters_.heaviest(particles_));
  }
  if (estimate_.updated) {
    const Pose2 since_then = base_in_odom_at_update_->inverse() * base_in_odom;
    estimate_.odom_in_map = estimate_.robot_in_map.pose * since_then * base_in_odom.inverse();
    estimate_.particles = particles_.size();
  }
  estimate_.robot_in_map.pose = estimate_.odom_in_map * base_in_odom;
  return estimate_;
}

}  // namespace coop::amcl
