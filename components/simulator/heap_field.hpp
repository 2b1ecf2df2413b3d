#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "core/pose.hpp"
#include "core/world/state.hpp"

namespace coop::simulator {

/// What happens to heaps of manure: the robot's scraper takes those that it passes over. A heap is
/// taken whole or not at all: when its centre comes below the blade while the robot drives
/// forwards, and the blade reaches over it on both sides. What the blade's end only grazes stays;
/// wheels do nothing to a heap.
class HeapField {
 public:
  /// `scraper`: the blade over the floor in base_link, m; empty where the robot has none.
  HeapField(const Eigen::AlignedBox2d& scraper, std::vector<world::Heap> heaps);

  /// State after the robot has moved by one tick from `before` to `after`, which must be so little
  /// that no heap passes unseen between them: less than the blade's depth.
  void step(const Pose2& before, const Pose2& after);

  [[nodiscard]] const std::vector<world::Heap>& heaps() const { return heaps_; }

  template <class Archive>
  void persist(Archive& archive) {
    for (world::Heap& heap : heaps_) archive(heap.state);
  }

 private:
  Eigen::AlignedBox2d scraper_;
  std::vector<world::Heap> heaps_;
};

}  // namespace coop::simulator
