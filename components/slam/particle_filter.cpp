#include "slam/particle_filter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "slam/resampling.hpp"

namespace coop::slam {

void SlamConfig::describe(config::Fields& fields) {
  fields.integer("particles", particles,
                 {.help = "trajectories followed at once", .min = 1, .max = 1000});
  fields.number("resolution", resolution,
                {.unit = "m", .help = "side of a cell", .min = 0.01, .max = 1.0});
  fields.number("min_translation", min_translation,
                {.unit = "m", .help = "a scan is used after this way", .min = 0.0, .max = 10.0});
  fields.number("min_rotation", min_rotation,
                {.unit = "rad", .help = "or after this turn", .min = 0.0, .max = 3.2});
  fields.number("max_interval", max_interval,
                {.unit = "s", .help = "or after this time; 0: never", .min = 0.0, .max = 3600.0});
  fields.number(
      "resample_threshold", resample_threshold,
      {.help = "resampled when a smaller share of the particles counts", .min = 0.0, .max = 1.0});
  fields.number("found_again", found_again,
                {.help = "mean log-likelihood a beam that tells the place after a restart",
                 .min = -10.0,
                 .max = 0.0});
  fields.number("occupied_threshold", occupied_threshold,
                {.help = "share of hits from which a cell is occupied", .min = 0.01, .max = 1.0});
  fields.section("scan", scan);
  fields.section("motion", motion);
  fields.section("matcher", matcher);
}

ParticleFilter::ParticleFilter(const SlamConfig& config, std::uint64_t seed, ForkJoin& workers)
    : config_(config), workers_(workers), resampling_stream_(seed, "slam resampling") {
  const auto count = static_cast<std::size_t>(config.particles);
  particles_.assign(count, Particle{Pose2{}, TileMap(config.resolution)});
  for (std::size_t i = 0; i < count; ++i)
    streams_.emplace_back(seed, "slam particle " + std::to_string(i));
  scratch_.assign(workers.workers(), Scratch{ScanMatcher(config.matcher), MapUpdater()});
  weights_.assign(count, 1.0 / static_cast<double>(count));
  parents_.resize(count);
  std::iota(parents_.begin(), parents_.end(), 0U);
}

ScanOutcome ParticleFilter::update(const LaserScan& scan, const OdometryFix& odometry,
                                   const Pose2& laser_in_base, const Pose2& sweep) {
  ScanOutcome outcome;
  const Pose2& base_in_odom = odometry.base_in_odom;
  const bool first = steps_.empty();
  const bool restarted = !first && piece_ != odometry.piece;
  const Pose2 motion = first ? Pose2{} : steps_.back().base_in_odom.inverse() * base_in_odom;
  if (!first && !restarted && !moved_enough(scan, motion)) return outcome;
  const ScanPoints points = to_points(scan, laser_in_base, sweep, config_.scan);
  if (points.empty()) return outcome;
  lost_ = !first && !move_all(points, motion, restarted);
  outcome.lost = lost_;
  failures_ = lost_ ? failures_ + 1 : 0;
  if (lost_) return outcome;
  piece_ = odometry.piece;
  workers_.run(particles_.size(), [&](std::size_t i, std::size_t worker) {
    scratch_[worker].updater.integrate(particles_[i].map, points, particles_[i].base_in_map);
  });
  Step step{scan.stamp, base_in_odom, {}, parents_};
  for (const auto& particle : particles_) step.poses.push_back(particle.base_in_map);
  steps_.push_back(std::move(step));
  outcome.used = true;
  outcome.mean_likelihood = particles_[best()].mean_likelihood;
  outcome.resampled = resample_if_needed();
  outcome.effective_particles = effective_count(weights_);
  return outcome;
}

bool ParticleFilter::moved_enough(const LaserScan& scan, const Pose2& motion) const {
  const double interval = to_seconds(scan.stamp - steps_.back().stamp);
  return std::hypot(motion.x, motion.y) >= config_.min_translation ||
         std::abs(motion.yaw) >= config_.min_rotation ||
         (config_.max_interval > 0.0 && interval >= config_.max_interval);
}

bool ParticleFilter::move_all(const ScanPoints& points, const Pose2& motion, bool restarted) {
  const Eigen::Vector3d stddev = motion_stddev(config_.motion, motion, restarted);
  const std::vector<Particle> before = restarted ? particles_ : std::vector<Particle>();
  workers_.run(particles_.size(), [&](std::size_t i, std::size_t worker) {
    move(particles_[i], streams_[i], scratch_[worker], points, motion, stddev);
  });
  if (!restarted || is_found()) return true;
  particles_ = before;
  return false;
}

bool ParticleFilter::is_found() const {
  // Who looks in many places must be stricter: one of them fits by chance.
  const double least = config_.found_again + (failures_ > 0 ? 0.1 : 0.0);
  return std::ranges::any_of(particles_, [least](const Particle& particle) {
    return particle.matched && particle.mean_likelihood >= least;
  });
}

void ParticleFilter::move(Particle& particle, RandomStream& random, Scratch& scratch,
                          const ScanPoints& points, const Pose2& motion,
                          const Eigen::Vector3d& stddev) const {
  const Pose2 predicted = particle.base_in_map * motion * search_offset(random);
  const Proposal proposal = scratch.matcher.match(particle.map, points, predicted, stddev);
  const Eigen::Matrix3d root = proposal.covariance.llt().matrixL();
  const double a = random.normal();
  const double b = random.normal();
  const double c = random.normal();
  const Eigen::Vector3d deviation = proposal.mean + root * Eigen::Vector3d(a, b, c);
  particle.base_in_map = predicted * Pose2{deviation.x(), deviation.y(), deviation.z()};
  particle.log_weight += proposal.log_evidence;
  particle.total_log_weight += proposal.log_evidence;
  particle.mean_likelihood = proposal.mean_likelihood;
  particle.matched = proposal.matched;
}

bool ParticleFilter::resample_if_needed() {
  std::vector<double> log_weights(particles_.size());
  std::ranges::transform(particles_, log_weights.begin(), &Particle::log_weight);
  weights_ = normalized_weights(log_weights);
  std::iota(parents_.begin(), parents_.end(), 0U);
  const auto count = static_cast<double>(particles_.size());
  if (effective_count(weights_) >= config_.resample_threshold * count) return false;
  const auto chosen = low_variance_resample(weights_, resampling_stream_.uniform());
  std::vector<Particle> survivors;
  survivors.reserve(particles_.size());
  for (const std::size_t source : chosen) survivors.push_back(particles_[source]);
  for (auto& survivor : survivors) survivor.log_weight = 0.0;
  particles_ = std::move(survivors);
  std::ranges::transform(chosen, parents_.begin(),
                         [](std::size_t source) { return static_cast<std::uint32_t>(source); });
  std::ranges::fill(weights_, 1.0 / count);
  return true;
}

/// Where a particle looks for the robot that was not found: each somewhere else.
Pose2 ParticleFilter::search_offset(RandomStream& random) const {
  constexpr int kMostWidenings = 5;
  if (failures_ == 0) return {};
  const double widenings = std::min(failures_, kMostWidenings);
  const double position = widenings * config_.motion.restart_position;
  const double yaw = std::min(widenings * config_.motion.restart_yaw, 1.0);
  const double x = random.normal(0.0, position);
  const double y = random.normal(0.0, position);
  return {x, y, random.normal(0.0, yaw)};
}

void ParticleFilter::resume(const TileMap& map, const std::vector<TrajectoryNode>& nodes) {
  particles_.assign(particles_.size(), Particle{nodes.back().base_in_map, map});
  std::ranges::fill(weights_, 1.0 / static_cast<double>(particles_.size()));
  std::iota(parents_.begin(), parents_.end(), 0U);
  steps_.clear();
  for (const TrajectoryNode& node : nodes) {
    steps_.push_back({node.stamp, node.base_in_odom,
                      std::vector<Pose2>(particles_.size(), node.base_in_map), parents_});
  }
  piece_.reset();
  lost_ = true;
}

std::size_t ParticleFilter::best() const {
  const auto found = std::ranges::max_element(particles_, {}, &Particle::total_log_weight);
  return static_cast<std::size_t>(found - particles_.begin());
}

Pose2 ParticleFilter::odom_in_map() const {
  if (steps_.empty()) return {};
  return particles_[best()].base_in_map * steps_.back().base_in_odom.inverse();
}

OccupancyGrid ParticleFilter::map() const {
  return particles_[best()].map.to_occupancy_grid(config_.occupied_threshold, 8);
}

std::vector<TrajectoryNode> ParticleFilter::trajectory() const {
  std::vector<TrajectoryNode> nodes(steps_.size());
  if (steps_.empty()) return nodes;
  std::size_t index = parents_[best()];
  for (std::size_t i = steps_.size(); i-- > 0;) {
    nodes[i] = {steps_[i].stamp, steps_[i].base_in_odom, steps_[i].poses[index]};
    index = steps_[i].parents[index];
  }
  return nodes;
}

}  // namespace coop::slam
