#include "experiments/slam/relations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/carmen/fields.hpp"

namespace coop::experiments {

std::vector<Relation> parse_relations(std::string_view text, const std::string& name) {
  std::vector<Relation> relations;
  carmen::for_each_line(text, name, [&](carmen::FieldCursor& fields) {
    Relation relation;
    relation.from = fields.stamp("t1");
    relation.to = fields.stamp("t2");
    relation.truth.x = fields.number("x");
    relation.truth.y = fields.number("y");
    for (const char* flat : {"z", "roll", "pitch"}) fields.number(flat);
    relation.truth.yaw = fields.number("yaw");
    relations.push_back(relation);
  });
  return relations;
}

Pose2 pose_at(std::span<const StampedPose2> trajectory, Time stamp) {
  const auto after = std::ranges::upper_bound(trajectory, stamp, {}, &StampedPose2::stamp);
  if (after == trajectory.begin()) return trajectory.front().pose;
  if (after == trajectory.end()) return trajectory.back().pose;
  const auto before = std::prev(after);
  const double ratio = to_seconds(stamp - before->stamp) / to_seconds(after->stamp - before->stamp);
  return interpolate(before->pose, after->pose, ratio);
}

Pose2 error_of(const Relation& relation, std::span<const StampedPose2> trajectory) {
  const Pose2 from = pose_at(trajectory, relation.from);
  const Pose2 to = pose_at(trajectory, relation.to);
  return relation.truth.inverse() * (from.inverse() * to);
}

RelationsError relations_error(std::span<const Relation> relations,
                               std::span<const StampedPose2> trajectory) {
  RelationsError error;
  error.relations = relations.size();
  if (relations.empty() || trajectory.empty()) return error;
  double square_translation = 0.0;
  double square_rotation = 0.0;
  for (const Relation& relation : relations) {
    const Pose2 lack = error_of(relation, trajectory);
    const double translation = std::hypot(lack.x, lack.y);
    const double rotation = std::abs(lack.yaw);
    error.mean_translation += translation;
    error.mean_rotation += rotation;
    square_translation += translation * translation;
    square_rotation += rotation * rotation;
    error.max_translation = std::max(error.max_translation, translation);
  }
  const auto count = static_cast<double>(relations.size());
  error.mean_translation /= count;
  error.mean_rotation /= count;
  const auto stddev = [count](double squares, double mean) {
    return std::sqrt(std::max(0.0, squares / count - mean * mean));
  };
  error.stddev_translation = stddev(square_translation, error.mean_translation);
  error.stddev_rotation = stddev(square_rotation, error.mean_rotation);
  return error;
}

std::string to_text(const RelationsError& error) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(),
                "%zu relations: translation %.4f +- %.4f m (max %.3f), rotation %.3f +- %.3f deg",
                error.relations, error.mean_translation, error.stddev_translation,
                error.max_translation, error.mean_rotation / kDegree,
                error.stddev_rotation / kDegree);
  return text.data();
}

}  // namespace coop::experiments
