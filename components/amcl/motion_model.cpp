#include "amcl/motion_model.hpp"

#include <cmath>
#include <numbers>

#include "core/arc.hpp"

namespace coop::amcl {
namespace {

double squared(double value) {
  return value * value;
}

}  // namespace

void ArcMotionConfig::describe(config::Fields& fields) {
  fields.number("distance_noise_per_distance", distance_noise_per_distance,
                {.unit = "m/sqrt(m)", .help = "error along the way, by way", .min = 0, .max = 1});
  fields.number(
      "distance_noise_per_turn", distance_noise_per_turn,
      {.unit = "m/sqrt(rad)", .help = "error along the way, by turn", .min = 0, .max = 1});
  fields.number("yaw_noise_per_distance", yaw_noise_per_distance,
                {.unit = "rad/sqrt(m)", .help = "heading error, by way", .min = 0, .max = 1});
  fields.number("yaw_noise_per_turn", yaw_noise_per_turn,
                {.unit = "rad/sqrt(rad)", .help = "heading error, by turn", .min = 0, .max = 1});
  fields.number("slip_noise_per_distance", slip_noise_per_distance,
                {.unit = "m/sqrt(m)", .help = "sideways slip, by way", .min = 0, .max = 1});
}

void ArcMotionModel::apply(ParticleSet& particles, const Pose2& motion,
                           RandomStream& random) const {
  const double turn = motion.yaw;
  // The chord seen from the heading half way through the turn: an ideal arc has no sideways part
  // there.
  const double c = std::cos(turn / 2.0);
  const double s = std::sin(turn / 2.0);
  const double forward = c * motion.x + s * motion.y;
  const double sideways = -s * motion.x + c * motion.y;
  const double arc = forward / chord_over_arc(turn / 2.0);

  const double way = std::hypot(arc, sideways);
  const double angle = std::abs(turn);
  const double arc_noise = std::sqrt(squared(config_.distance_noise_per_distance) * way +
                                     squared(config_.distance_noise_per_turn) * angle);
  const double turn_variance =
      squared(config_.yaw_noise_per_distance) * way + squared(config_.yaw_noise_per_turn) * angle;
  const double turn_noise = std::sqrt(turn_variance);
  const double slip_noise = std::sqrt(squared(config_.slip_noise_per_distance) * way +
                                      turn_variance * squared(way) / 12.0);

  constexpr float kPi = std::numbers::pi_v<float>;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double noisy_turn = turn + turn_noise * random.normal();
    const double noisy_arc = arc + arc_noise * random.normal();
    const double chord = noisy_arc * chord_over_arc(noisy_turn / 2.0);
    const double side = sideways + slip_noise * random.normal();
    const double yaw = static_cast<double>(particles.yaw[i]);
    const double cos_mid = std::cos(yaw + noisy_turn / 2.0);
    const double sin_mid = std::sin(yaw + noisy_turn / 2.0);
    particles.x[i] += static_cast<float>(chord * cos_mid - side * sin_mid);
    particles.y[i] += static_cast<float>(chord * sin_mid + side * cos_mid);
    auto folded = static_cast<float>(normalize_angle(yaw + noisy_turn));
    if (folded >= kPi) folded = -kPi;  // rounding up to float may touch the open end
    particles.yaw[i] = folded;
  }
}

}  // namespace coop::amcl
