#include "core/costmap/animal_tracks.hpp"

#include <algorithm>

namespace coop {

void AnimalTracksConfig::describe(config::Fields& fields) {
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

AnimalTracks::Animal* AnimalTracks::nearest(const Eigen::Vector2d& seen, Time stamp,
                                            const std::vector<std::uint8_t>& taken) {
  Animal* best = nullptr;
  double best_distance = config_.same_animal;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (taken[i] != 0) continue;
    const double age = to_seconds(stamp - animals_[i].stamp);
    const double distance = (predicted(animals_[i], age).center - seen).norm();
    if (distance > best_distance) continue;
    best_distance = distance;
    best = &animals_[i];
  }
  return best;
}

void AnimalTracks::follow(Animal& animal, const Eigen::Vector2d& seen, Time stamp) const {
  const double age = to_seconds(stamp - animal.stamp);
  if (age > 0.0) {
    const Eigen::Vector2d measured = (seen - animal.center_in_map) / age;
    animal.velocity_in_map += config_.responsiveness * (measured - animal.velocity_in_map);
    const double speed = animal.velocity_in_map.norm();
    if (speed > config_.max_speed) animal.velocity_in_map *= config_.max_speed / speed;
  }
  animal.stamp = stamp;
  animal.center_in_map = seen;
}

bool AnimalTracks::see(const std::vector<Detection>& animals, Time stamp) {
  if (animals.size() > kMaxAnimals) return false;
  if (stamp < last_) return true;
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
    follow(*animal, seen, stamp);
    animal->radius = radius;
  }
  return true;
}

}  // namespace coop
