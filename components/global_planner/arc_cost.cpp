#include "global_planner/arc_cost.hpp"

#include <algorithm>
#include <cmath>

#include "core/arc.hpp"

namespace coop::global_planner {
namespace {

constexpr double kCheckSpacing = 0.11;  ///< m between collision checks along an arc

}  // namespace

void ArcCostConfig::describe(config::Fields& fields) {
  fields.number("reverse_weight", reverse_weight,
                {.help = "cost of a metre driven backwards", .min = 1, .max = 20});
  fields.number("cusp_cost", cusp_cost,
                {.unit = "m", .help = "for each change of direction", .min = 0, .max = 20});
  fields.number("turn_weight", turn_weight,
                {.help = "extra cost of a metre at the smallest radius", .min = 0, .max = 10});
  fields.number("steering_cost", steering_cost,
                {.unit = "m",
                 .help = "for steering from straight to the smallest radius",
                 .min = 0,
                 .max = 10});
  fields.number("clearance", clearance,
                {.unit = "m",
                 .help = "free space beside the padded footprint wished for",
                 .min = 0.01,
                 .max = 5});
  fields.number(
      "clearance_weight", clearance_weight,
      {.help = "extra cost of a metre driven without any clearance", .min = 0, .max = 50});
}

// One sine and cosine an arc: from part to part the heading turns by the same angle.
ArcCost::Driven ArcCost::drive(const TraversalGrid& grid, const PoseChecker& poses,
                               const Start& start, const Arc& arc) const {
  const int parts =
      std::max(1, static_cast<int>(std::ceil(std::abs(arc.length) / kCheckSpacing - 1e-6)));
  const double part = arc.length / parts;
  const double half = 0.5 * part * arc.curvature;
  const double sine = std::sin(half);
  const double cosine = std::cos(half);
  const double chord = part * chord_over_arc(half);
  const double turn_cosine = 1.0 - 2.0 * sine * sine;
  const double turn_sine = 2.0 * sine * cosine;
  const double weight = (arc.length < 0.0 ? config_.reverse_weight : 1.0) +
                        config_.turn_weight * std::abs(arc.curvature) * radius_;
  CollisionChecker::Placement at = start.placement;
  double cost = 0.0;
  for (int i = 0; i < parts; ++i) {
    at.x += chord * (at.cosine * cosine - at.sine * sine);
    at.y += chord * (at.sine * cosine + at.cosine * sine);
    const double turned = at.cosine * turn_cosine - at.sine * turn_sine;
    at.sine = at.sine * turn_cosine + at.cosine * turn_sine;
    at.cosine = turned;
    if (!poses.free(at)) return {};
    const Cell cell = grid.geometry().cell_of({at.x, at.y});
    const float factor = grid.factor(grid.padded_index(cell));
    const double ground = std::isfinite(factor) ? factor : grid.largest_factor();
    const double missing = 1.0 - poses.clearance(at) / config_.clearance;
    const double narrow = config_.clearance_weight * std::clamp(missing, 0.0, 1.0);
    cost += std::abs(part) * (ground * weight + narrow);
  }
  const double yaw = normalize_angle(start.pose.yaw + arc.length * arc.curvature);
  return {cost, {{at.x, at.y, yaw}, at}};
}

double ArcCost::change(int direction, double curvature, const Arc& next) const {
  const double steering = std::abs(next.curvature - curvature) * radius_;
  const bool cusp = direction != 0 && (next.length < 0.0) != (direction < 0);
  return config_.steering_cost * steering + (cusp ? config_.cusp_cost : 0.0);
}

}  // namespace coop::global_planner
