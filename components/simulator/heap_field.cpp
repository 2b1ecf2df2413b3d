#include "simulator/heap_field.hpp"

#include <utility>

namespace coop::simulator {

HeapField::HeapField(const Eigen::AlignedBox2d& scraper, std::vector<world::Heap> heaps)
    : scraper_(scraper), heaps_(std::move(heaps)) {}

void HeapField::step(const Pose2& before, const Pose2& after) {
  const Pose2 after_in_before = before.inverse() * after;
  if (scraper_.isEmpty() || after_in_before.x <= 0.0) return;
  const Pose2 world_in_base = after.inverse();
  for (world::Heap& heap : heaps_) {
    if (heap.state != world::HeapState::kOnFloor) continue;
    const Eigen::Vector2d in_base = world_in_base * heap.position;
    const bool below = in_base.x() >= scraper_.min().x() && in_base.x() <= scraper_.max().x();
    const bool whole = in_base.y() - heap.radius >= scraper_.min().y() &&
                       in_base.y() + heap.radius <= scraper_.max().y();
    if (below && whole) heap.state = world::HeapState::kCleaned;
  }
}

}  // namespace coop::simulator
