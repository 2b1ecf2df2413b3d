#include "core/robot/robot_model.hpp"

#include <algorithm>
#include <cmath>

#include "core/atomic_file.hpp"
#include "core/config/error.hpp"
#include "core/robot/urdf_reader.hpp"

namespace coop::robot {
namespace {

double cross(const Eigen::Vector2d& o, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

/// Andrew's monotone chain; counter-clockwise, without collinear points.
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  std::ranges::sort(points, [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Eigen::Vector2d> hull;
  const auto add_side = [&hull](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), *it) <= 1e-12) {
        hull.pop_back();
      }
      hull.push_back(*it);
    }
    hull.pop_back();
  };
  add_side(points.begin(), points.end());
  add_side(points.rbegin(), points.rend());
  return hull;
}

}  // namespace

Pose3 Joint::child_in_parent(double position) const {
  Pose3 pose = origin;
  if (type == JointType::kRevolute || type == JointType::kContinuous) {
    pose.rotate(Eigen::AngleAxisd(position, axis));
  } else if (type == JointType::kPrismatic) {
    pose.translate(position * axis);
  }
  return pose;
}

double AckermannGeometry::min_turning_radius() const {
  return wheelbase / std::tan(max_steering_angle);
}

RobotModel RobotModel::load(const std::filesystem::path& path) {
  std::string text;
  try {
    text = read_file(path);
  } catch (const std::exception& error) {
    throw config::Error(std::string("robot description: ") + error.what());
  }
  return parse(text, path.string());
}

RobotModel RobotModel::parse(const std::string& urdf, const std::string& source) {
  UrdfTree tree = read_urdf(urdf, source);
  RobotModel model;
  model.source_ = source;
  model.urdf_ = urdf;
  model.name_ = std::move(tree.name);
  model.links_ = std::move(tree.links);
  model.joints_ = std::move(tree.joints);
  return model;
}

void RobotModel::refuse(const std::string& reason) const {
  throw config::Error(source_ + ": " + reason);
}

bool RobotModel::has_link(std::string_view name) const {
  return std::ranges::find(links_, name, &Link::name) != links_.end();
}

const Link& RobotModel::link(std::string_view name) const {
  const auto found = std::ranges::find(links_, name, &Link::name);
  if (found == links_.end()) refuse("there is no link '" + std::string(name) + "'");
  return *found;
}

const Joint& RobotModel::joint(std::string_view name) const {
  const auto found = std::ranges::find(joints_, name, &Joint::name);
  if (found == joints_.end()) refuse("there is no joint '" + std::string(name) + "'");
  return *found;
}

const Joint* RobotModel::parent_joint(std::string_view name) const {
  const auto found = std::ranges::find(joints_, name, &Joint::child);
  return found == joints_.end() ? nullptr : &*found;
}

std::vector<Joint> RobotModel::chain(std::string_view base, std::string_view tip) const {
  (void)link(base);
  (void)link(tip);
  std::vector<Joint> joints;
  for (std::string_view at = tip; at != base;) {
    const Joint* up = parent_joint(at);
    if (up == nullptr) {
      refuse("link '" + std::string(tip) + "' does not hang on link '" + std::string(base) + "'");
    }
    joints.push_back(*up);
    at = up->parent;
  }
  std::ranges::reverse(joints);
  return joints;
}

Pose3 RobotModel::mount(std::string_view name, std::string_view reference) const {
  Pose3 pose = Pose3::Identity();
  for (const Joint& step : chain(reference, name)) {
    if (step.is_movable()) {
      refuse("link '" + std::string(name) + "' is not fixed to '" + std::string(reference) +
             "': joint '" + step.name + "' moves");
    }
    pose = pose * step.origin;
  }
  return pose;
}

std::vector<Eigen::Vector2d> RobotModel::footprint() const {
  if (root() != kBaseLink) refuse("the root link is '" + root() + "', expected 'base_link'");
  std::vector<Eigen::Vector2d> corners;
  for (const CollisionShape& shape : link(kBaseLink).collision) {
    if (shape.kind != CollisionShape::Kind::kBox) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d sign((corner & 1) ? 0.5 : -0.5, (corner & 2) ? 0.5 : -0.5,
                                 (corner & 4) ? 0.5 : -0.5);
      corners.emplace_back((shape.in_link * sign.cwiseProduct(shape.size).eval()).head<2>());
    }
  }
  if (corners.empty()) {
    refuse("base_link has no collision box, so there is no footprint");
  }
  return convex_hull(std::move(corners));
}

Eigen::AlignedBox2d RobotModel::scraper() const {
  const auto& shapes = link(kScraperLink).collision;
  if (shapes.empty() || shapes[0].kind != CollisionShape::Kind::kBox) {
    refuse("link 'scraper_link' needs a collision box, the blade");
  }
  const Eigen::Vector2d middle = (mount(kScraperLink) * shapes[0].in_link).translation().head<2>();
  const Eigen::Vector2d half = 0.5 * shapes[0].size.head<2>();
  return {Eigen::Vector2d(middle - half), Eigen::Vector2d(middle + half)};
}

AckermannGeometry RobotModel::ackermann() const {
  if (root() != kBaseLink) refuse("the root link is '" + root() + "', expected 'base_link'");
  std::vector<const Joint*> kingpins;
  std::vector<const Joint*> wheels;
  for (const Joint& candidate : joints_) {
    if (candidate.parent != kBaseLink) continue;
    if (candidate.name.ends_with("_steering_joint")) kingpins.push_back(&candidate);
    if (candidate.name.starts_with("rear_") && candidate.name.ends_with("_wheel_joint")) {
      wheels.push_back(&candidate);
    }
  }
  if (kingpins.size() != 2) refuse("expected two joints *_steering_joint on base_link");
  if (wheels.size() != 2) refuse("expected two joints rear_*_wheel_joint on base_link");
  const Eigen::Vector3d a = kingpins[0]->origin.translation();
  const Eigen::Vector3d b = kingpins[1]->origin.translation();
  if (std::abs(a.x() - b.x()) > 1e-6 || std::abs(a.y() + b.y()) > 1e-6 || a.x() <= 0.0) {
    refuse("the steering joints do not lie symmetrically before base_link");
  }
  const double limit =
      std::min({kingpins[0]->upper, kingpins[1]->upper, -kingpins[0]->lower, -kingpins[1]->lower});
  if (!(limit > 0.0 && limit < 1.5)) {
    refuse("the limits of the steering joints must include 0 and stay below 1.5 rad");
  }
  const std::vector<CollisionShape>& tyre = link(wheels[0]->child).collision;
  if (tyre.empty() || tyre[0].kind != CollisionShape::Kind::kCylinder) {
    refuse("link '" + wheels[0]->child + "' needs a collision cylinder, the wheel");
  }
  if (std::abs(wheels[0]->origin.translation().x()) > 1e-6 ||
      std::abs(wheels[1]->origin.translation().x()) > 1e-6) {
    refuse("base_link does not lie on the rear axle");
  }
  AckermannGeometry geometry;
  geometry.wheelbase = a.x();
  geometry.track = std::abs(a.y() - b.y());
  geometry.wheel_radius = 0.5 * tyre[0].size.x();
  // All wheels turn about one point on the line of the rear axle; the inner wheel is the steepest.
  geometry.max_steering_angle =
      std::atan(geometry.wheelbase / (geometry.wheelbase / std::tan(limit) + 0.5 * geometry.track));
  geometry.max_steering_rate = std::min(kingpins[0]->max_velocity, kingpins[1]->max_velocity);
  return geometry;
}

}  // namespace coop::robot
