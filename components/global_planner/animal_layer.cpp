#include "global_planner/animal_layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace coop::global_planner {
namespace {

constexpr double kUnderRobot = 0.05;  ///< m around the footprint

Eigen::Vector2d predicted(const AnimalLayer::Animal& animal, double seconds) {
  return animal.center_in_map + seconds * animal.velocity_in_map;
}

}  // namespace

void AnimalLayerConfig::describe(config::Fields& fields) {
  fields.number("horizon", horizon,
                {.unit = "s", .help = "an animal's way is predicted so far", .min = 0, .max = 10});
  fields.number("spread", spread,
                {.unit = "m/s",
                 .help = "by which an animal may stray from the prediction",
                 .min = 0,
                 .max = 2});
  fields.number("max_age", max_age,
                {.unit = "s", .help = "unseen so long, it is forgotten", .min = 0, .max = 60});
  fields.number("same_animal", same_animal,
                {.unit = "m",
                 .help = "seen this near to where it was predicted, it is the same",
                 .min = 0.01,
                 .max = 5});
  fields.number("max_speed", max_speed,
                {.unit = "m/s", .help = "of an animal", .min = 0, .max = 10});
  fields.number("responsiveness", responsiveness,
                {.help = "share of a new measurement in the velocity", .min = 0, .max = 1});
}

AnimalLayer::Animal* AnimalLayer::nearest(const Eigen::Vector2d& seen, Time stamp,
                                          const std::vector<std::uint8_t>& taken) {
  Animal* best = nullptr;
  double best_distance = config_.same_animal;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (taken[i] != 0) continue;
    const double age = to_seconds(stamp - animals_[i].stamp);
    const double distance = (predicted(animals_[i], age) - seen).norm();
    if (distance > best_distance) continue;
    best_distance = distance;
    best = &animals_[i];
  }
  return best;
}

void AnimalLayer::follow(Animal& animal, const Eigen::Vector2d& seen, Time stamp,
                         const AnimalLayerConfig& config) {
  const double age = to_seconds(stamp - animal.stamp);
  if (age > 0.0) {
    const Eigen::Vector2d measured = (seen - animal.center_in_map) / age;
    animal.velocity_in_map += config.responsiveness * (measured - animal.velocity_in_map);
    const double speed = animal.velocity_in_map.norm();
    if (speed > config.max_speed) animal.velocity_in_map *= config.max_speed / speed;
  }
  animal.stamp = stamp;
  animal.center_in_map = seen;
}

void AnimalLayer::see(const std::vector<Detection>& animals, Time stamp) {
  if (stamp < last_) return;
  last_ = stamp;
  std::erase_if(animals_, [&](const Animal& animal) {
    return to_seconds(stamp - animal.stamp) > config_.max_age;
  });
  std::vector<std::uint8_t> taken(animals_.size(), 0);
  for (const Detection& detection : animals) {
    const Eigen::Vector2d seen = detection.position.head<2>();
    const double radius = 0.5 * std::max(detection.size.x(), detection.size.y());
    Animal* animal = nearest(seen, stamp, taken);
    if (animal == nullptr) {
      animals_.push_back({stamp, seen, {0, 0}, radius});
      continue;
    }
    taken[static_cast<std::size_t>(animal - animals_.data())] = 1;
    follow(*animal, seen, stamp, config_);
    animal->radius = radius;
  }
}

void AnimalLayer::mark(const GridGeometry& grid, Time now, const std::optional<Pose2>& robot_in_map,
                       const Footprint& footprint, std::span<std::uint8_t> cells) const {
  const auto cover = [&](const Eigen::Vector2d& center, double radius) {
    const Cell low = grid.cell_of(center - Eigen::Vector2d(radius, radius));
    const Cell high = grid.cell_of(center + Eigen::Vector2d(radius, radius));
    for (int y = std::max(low.y, 0); y <= std::min(high.y, grid.height - 1); ++y) {
      for (int x = std::max(low.x, 0); x <= std::min(high.x, grid.width - 1); ++x) {
        const Eigen::Vector2d point = grid.center_of({x, y});
        if ((point - center).norm() > radius) continue;
        const bool under_robot =
            robot_in_map && footprint.depth(robot_in_map->inverse() * point) > -kUnderRobot;
        if (!under_robot) cells[grid.index({x, y})] = 1;
      }
    }
  };
  for (const Animal& animal : animals_) {
    const double age = to_seconds(now - animal.stamp);
    if (age < 0.0 || age > config_.max_age) continue;
    const double way = animal.velocity_in_map.norm() * config_.horizon;
    const int steps = std::max(1, static_cast<int>(std::ceil(way / grid.resolution)));
    for (int step = 0; step <= steps; ++step) {
      const double ahead = age + config_.horizon * step / steps;
      cover(predicted(animal, ahead), animal.radius + config_.spread * ahead);
    }
  }
}

}  // namespace coop::global_planner
