#include "arm_driver/arm_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/config/error.hpp"

namespace coop::arm_driver {
namespace {

using Eigen::Vector3d;

const Vector3d kDown(0.0, 0.0, -1.0);

JointVector home_of(const KinematicChain& chain, const std::vector<double>& home) {
  JointVector posture = JointVector::Zero(chain.size());
  if (home.empty()) return posture.cwiseMax(chain.lower()).cwiseMin(chain.upper());
  if (static_cast<int>(home.size()) != chain.size()) {
    throw config::Error("motion.home: one angle for each of the arm's " +
                        std::to_string(chain.size()) + " joints is expected, not " +
                        std::to_string(home.size()));
  }
  for (int i = 0; i < chain.size(); ++i) posture[i] = home[static_cast<std::size_t>(i)];
  if (!chain.within_limits(posture)) {
    throw config::Error("motion.home: lies beyond the limits of the arm's joints");
  }
  return posture;
}

}  // namespace

void ArmMotionConfig::describe(config::Fields& fields) {
  fields.number(
      "speed", speed,
      {.help = "part of the joints' velocity limits that is used", .min = 0.05, .max = 1});
  fields.number("acceleration", acceleration,
                {.unit = "rad/s2", .help = "of every joint", .min = 0.1, .max = 100});
  fields.numbers(
      "home", home,
      {.unit = "rad", .help = "posture of rest, one angle a joint", .min = -7, .max = 7});
  fields.number(
      "contact_height", contact_height,
      {.unit = "m", .help = "of the cup on an egg, above the floor", .min = 0, .max = 0.3});
  fields.number("approach_height", approach_height,
                {.unit = "m", .help = "above the contact", .min = 0.02, .max = 0.5});
  fields.number("lift_height", lift_height,
                {.unit = "m", .help = "above the contact, with the egg", .min = 0.02, .max = 0.5});
  fields.number("basket_clearance", basket_clearance,
                {.unit = "m", .help = "above the point of release", .min = 0, .max = 0.5});
  fields.number("search_radius", search_radius,
                {.unit = "m", .help = "of the circle searched for the egg", .min = 0, .max = 0.2});
  fields.integer("search_points", search_points,
                 {.help = "touches on that circle, 0: none", .min = 0, .max = 24});
  fields.number("search_lift", search_lift,
                {.unit = "m", .help = "rise of the cup between touches", .min = 0, .max = 0.5});
}

ArmMotion::ArmMotion(const robot::RobotModel& model, const ArmMotionConfig& config)
    : config_(config), ik_(KinematicChain(model.arm(), model.mount(robot::kArmBaseLink))) {
  limits_.velocity = config.speed * chain().max_velocity();
  limits_.acceleration = JointVector::Constant(chain().size(), config.acceleration);
  home_ = home_of(chain(), config.home);
  const Vector3d release = model.mount(robot::kBasketLink).translation();
  const auto above = posture_at(release + Vector3d(0, 0, config.basket_clearance));
  const auto at = above ? ik_.solve({release, kDown}, *above) : above;
  if (!above || !at) {
    throw config::Error("robot: the basket is " + std::string(to_string(at.error())) +
                        " for the arm");
  }
  above_basket_ = *above;
  at_basket_ = *at;
}

Vector3d ArmMotion::tip(const JointVector& positions) const {
  return chain().tip_in_reference(positions).translation();
}

Result<JointVector, IkError> ArmMotion::posture_at(const Vector3d& point) const {
  return ik_.solve({point, kDown}, home_);
}

Result<std::vector<Vector3d>, IkError> ArmMotion::touches(const Eigen::Vector2d& egg) const {
  const Vector3d rise(0, 0, std::max(config_.approach_height, config_.lift_height));
  std::vector<Vector3d> points;
  for (int i = 0; i <= config_.search_points; ++i) {
    Vector3d point(egg.x(), egg.y(), config_.contact_height);
    if (i > 0) {
      // Opposite points in turn: the error is as likely on either side.
      const int step = i % 2 == 1 ? i / 2 : i / 2 - 1 + (config_.search_points + 1) / 2;
      const double angle = 2.0 * std::numbers::pi * step / config_.search_points;
      point += config_.search_radius * Vector3d(std::cos(angle), std::sin(angle), 0.0);
    }
    const auto touching = posture_at(point);
    const auto above = touching ? posture_at(point + rise) : touching;
    if (above) {
      points.push_back(point);
    } else if (i == 0) {
      return fail(above.error());
    }
  }
  return points;
}

JointTrajectory ArmMotion::to(const JointVector& from, const JointVector& goal) const {
  return JointTrajectory({from, goal}, limits_);
}

JointTrajectory ArmMotion::straight_to(const JointVector& from, const Vector3d& point) const {
  constexpr int kParts = 4;
  const Vector3d start = tip(from);
  std::vector<JointVector> path{from};
  for (int i = 1; i <= kParts; ++i) {
    const Vector3d way_point = start + (point - start) * (static_cast<double>(i) / kParts);
    const auto posture = ik_.solve({way_point, kDown}, path.back());
    if (!posture) break;
    path.push_back(*posture);
  }
  if (path.size() == kParts + 1) {
    // From another branch of solutions the line would be none.
    const double turn = (path.back() - from).cwiseAbs().maxCoeff();
    if (turn < std::numbers::pi / 2) return JointTrajectory(std::move(path), limits_);
  }
  const auto goal = posture_at(point);
  return to(from, goal ? *goal : from);
}

}  // namespace coop::arm_driver
