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

ScanOutcome ParticleFilter::update(const LaserScan& scan, const Pose2& base_in_odom,
                                   const Pose2& laser_in_base, const Pose2& sweep) {
  ScanOutcome outcome;
  const bool first = steps_.empty();
  const Pose2 motion = first ? Pose2{} : steps_.back().base_in_odom.inverse() * base_in_odom;
  if (!first && !moved_enough(scan, motion)) return outcome;
  const ScanPoints points = to_points(scan, laser_in_base, sweep, config_.scan);
  if (points.empty()) return outcome;
  workers_.run(particles_.size(), [&](std::size_t i, std::size_t worker) {
    if (!first) move(particles_[i], streams_[i], scratch_[worker], points, motion);
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

void ParticleFilter::move(Particle& particle, RandomStream& random, Scratch& scratch,
                          const ScanPoints& points, const Pose2& motion) {
  const Pose2 predicted = particle.base_in_map * motion;
  const Proposal proposal =
      scratch.matcher.match(particle.map, points, predicted, motion_stddev(config_.motion, motion));
  const Eigen::Matrix3d root = proposal.covariance.llt().matrixL();
  const double a = random.normal();
  const double b = random.normal();
  const double c = random.normal();
  const Eigen::Vector3d deviation = proposal.mean + root * Eigen::Vector3d(a, b, c);
  particle.base_in_map = predicted * Pose2{deviation.x(), deviation.y(), deviation.z()};
  particle.log_weight += proposal.log_evidence;
  particle.total_log_weight += proposal.log_evidence;
  particle.mean_likelihood = proposal.mean_likelihood;
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
