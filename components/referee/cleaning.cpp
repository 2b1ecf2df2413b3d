#include "referee/cleaning.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace coop::referee {

std::vector<std::string> heap_columns() {
  return {"seed",  "number", "heap",         "x",           "y",       "radius", "covered",
          "taken", "time",   "mission_time", "path_length", "animals", "others"};
}

std::vector<std::string> to_row(const CleanedHeap& heap, std::uint64_t seed, int number,
                                double mission_time) {
  return {std::to_string(seed),
          std::to_string(number),
          heap.heap.id,
          fmt::format("{:.3f}", heap.heap.position.x()),
          fmt::format("{:.3f}", heap.heap.position.y()),
          fmt::format("{:.3f}", heap.heap.radius),
          heap.covered ? "1" : "0",
          heap.heap.state == world::HeapState::kCleaned ? "1" : "0",
          fmt::format("{:.2f}", heap.time),
          fmt::format("{:.2f}", mission_time),
          fmt::format("{:.3f}", heap.path_length),
          std::to_string(heap.animals),
          std::to_string(heap.others)};
}

void Cleaning::begin(const world::World& world) {
  if (waiting_.empty() && covered_.empty()) waiting_ = world.heaps;
}

void Cleaning::begin_mission(Time now) {
  if (!begun_) begun_ = now;
}

double Cleaning::seconds_of_mission(Time now) const {
  return begun_ ? std::max(0.0, to_seconds(now - *begun_)) : 0.0;
}

double Cleaning::mission_time() const {
  return truth_ ? seconds_of_mission(truth_->stamp) : 0.0;
}

bool Cleaning::covers(const world::Heap& heap, const Pose2& before, const Pose2& after) const {
  const Eigen::Vector2d was = before.inverse() * heap.position;
  const Eigen::Vector2d is = after.inverse() * heap.position;
  // The middle comes from ahead of the blade's rear edge, below the blade or past it in one step.
  const bool passed =
      is.x() < was.x() && is.x() <= scraper_.max().x() && was.x() >= scraper_.min().x();
  return passed && is.y() - heap.radius >= scraper_.min().y() &&
         is.y() + heap.radius <= scraper_.max().y();
}

void Cleaning::see(const world::GroundTruth& truth) {
  if (truth_) {
    const Pose2& before = truth_->robot_in_world;
    const Pose2& after = truth.robot_in_world;
    const std::uint32_t collisions = truth.collision_count - truth_->collision_count;
    const std::uint32_t animals = truth.animal_collision_count - truth_->animal_collision_count;
    open_.path_length += distance(before, after);
    open_.animals += animals;
    open_.others += collisions - animals;
    const bool forwards = (before.inverse() * after).x > 0.0;
    for (const world::Heap& heap : waiting_) {
      if (!forwards || !covers(heap, before, after)) continue;
      open_.heap = heap;
      open_.covered = true;
      open_.time = seconds_of_mission(truth.stamp);
      covered_.push_back(open_);
      open_ = {};
    }
    std::erase_if(waiting_, [&](const world::Heap& heap) {
      return std::ranges::any_of(covered_,
                                 [&](const CleanedHeap& done) { return done.heap.id == heap.id; });
    });
  }
  truth_ = truth;
}

std::vector<CleanedHeap> Cleaning::heaps() const {
  std::vector<CleanedHeap> all = covered_;
  for (const world::Heap& heap : waiting_) {
    CleanedHeap left;
    left.heap = heap;
    left.time = mission_time();
    all.push_back(left);
  }
  if (!truth_ || all.empty()) return all;
  all.back().path_length += open_.path_length;
  all.back().animals += open_.animals;
  all.back().others += open_.others;
  for (CleanedHeap& heap : all) {
    const auto now = std::ranges::find(truth_->heaps, heap.heap.id, &world::Heap::id);
    if (now != truth_->heaps.end()) heap.heap.state = now->state;
  }
  return all;
}

}  // namespace coop::referee
