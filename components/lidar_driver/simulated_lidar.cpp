#include "lidar_driver/simulated_lidar.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/config/error.hpp"
#include "core/random.hpp"
#include "core/robot/robot_model.hpp"

namespace coop::lidar_driver {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
// REP 117.
constexpr double kNothing = std::numeric_limits<double>::infinity();
constexpr double kTooNear = -kNothing;
constexpr double kNoMeasurement = std::numeric_limits<double>::quiet_NaN();

/// Seeds of neighbouring stamps must not be neighbours in any bit pattern the generator could show.
std::uint64_t seed_of_scan(std::uint64_t seed, Time stamp) {
  return seed ^ (static_cast<std::uint64_t>(to_nanoseconds(stamp)) * 0x9E3779B97F4A7C15ULL);
}

}  // namespace

void SimulatedLidarConfig::describe(config::Fields& fields) {
  fields.integer("beams", beams, {.unit = "1", .help = "beams a turn", .min = 4, .max = 100000});
  fields.number("range_min", range_min,
                {.unit = "m", .help = "nearest range", .min = 0, .max = 10});
  fields.number("range_max", range_max,
                {.unit = "m", .help = "farthest range", .min = 0.1, .max = 300});
  fields.number("range_noise", range_noise,
                {.unit = "m", .help = "deviation of one range", .min = 0, .max = 1});
  fields.number("range_noise_share", range_noise_share,
                {.unit = "1", .help = "deviation as a share of the range", .min = 0, .max = 0.2});
  fields.number(
      "mount_yaw_spread", mount_yaw_spread,
      {.unit = "rad", .help = "deviation over runs of how it is mounted", .min = 0, .max = 0.5});
  fields.number("dropout", dropout,
                {.unit = "1", .help = "share of beams without a measurement", .min = 0, .max = 1});
}

void SimulatedLidarConfig::validate() const {
  if (range_min >= range_max) throw config::Error("range_min: expected less than range_max");
}

SimulatedLidar::SimulatedLidar(const SimulatedLidarConfig& config, const world::World& world,
                               const Pose2& laser_in_base, std::uint64_t seed)
    : config_(config), walls_(world.grid), laser_in_base_(laser_in_base), seed_(seed) {
  RandomStream mount(seed, "lidar/mount");
  laser_in_base_.yaw += mount.normal(0.0, config.mount_yaw_spread);
  for (int i = 0; i < config.beams; ++i) streams_.push_back("lidar/beam/" + std::to_string(i));
}

double SimulatedLidar::true_range(const world::GroundTruth& truth, const Eigen::Vector2d& origin,
                                  const Eigen::Vector2d& direction) const {
  const auto hit = walls_.cast(origin, direction, config_.range_max);
  double range = hit ? hit->range : kNothing;
  for (const world::Animal& animal : truth.animals) {
    const auto at = world::intersect_disc(origin, direction, animal.position, animal.radius);
    if (at && *at < range) range = *at;
  }
  return range;
}

void SimulatedLidar::measure(const world::GroundTruth& truth, LaserScan& scan) const {
  const auto beams = static_cast<std::size_t>(config_.beams);
  scan.stamp = truth.stamp;
  scan.frame_id = robot::kLaserLink;
  scan.angle_min = static_cast<float>(-std::numbers::pi);
  scan.angle_increment = static_cast<float>(kTurn / config_.beams);
  scan.range_min = static_cast<float>(config_.range_min);
  scan.range_max = static_cast<float>(config_.range_max);
  scan.ranges.resize(beams);

  const Pose2 laser_in_world = truth.robot_in_world * laser_in_base_;
  const std::uint64_t seed = seed_of_scan(seed_, truth.stamp);
  for (std::size_t i = 0; i < beams; ++i) {
    const double angle = laser_in_world.yaw + static_cast<double>(scan.angle(i));
    double range = true_range(truth, laser_in_world.position(), {std::cos(angle), std::sin(angle)});
    RandomStream noise(seed, streams_[i]);
    const bool lost = noise.uniform() < config_.dropout;
    const double deviation = noise.normal();
    // Nothing met stays nothing met: infinity times zero would be no number.
    if (std::isfinite(range)) {
      range += deviation * (config_.range_noise + config_.range_noise_share * range);
    }
    if (lost) {
      range = kNoMeasurement;
    } else if (range > config_.range_max) {
      range = kNothing;
    } else if (range < config_.range_min) {
      range = kTooNear;
    }
    scan.ranges[i] = static_cast<float>(range);
  }
}

}  // namespace coop::lidar_driver
