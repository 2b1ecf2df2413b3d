#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "core/world/state.hpp"

namespace coop::referee {

/// What became of one heap of manure.
struct CleanedHeap {
  world::Heap heap;           ///< as it lay at the start, and what the simulator says of it now
  bool covered = false;       ///< the blade passed over it as a whole, on a drive forwards
  double time = 0.0;          ///< s since the mission began; of its end where it was not covered
  double path_length = 0.0;   ///< m driven since the heap before it
  std::uint32_t animals = 0;  ///< collisions with animals begun since the heap before it
  std::uint32_t others = 0;   ///< other collisions likewise
};

/// Columns of heaps.csv, and a row of it; times are s, lengths m. `mission_time` is the whole
/// mission's, the same in every row of a run.
[[nodiscard]] std::vector<std::string> heap_columns();
[[nodiscard]] std::vector<std::string> to_row(const CleanedHeap& heap, std::uint64_t seed,
                                              int number, double mission_time);

/// Judges a cleaning by the true poses of the robot and the places of the heaps: a heap is clean
/// when the blade came over its middle while the robot drove forwards, and reached over it on both
/// sides.
class Cleaning {
 public:
  /// `scraper`: the blade over the floor in base_link, m.
  explicit Cleaning(const Eigen::AlignedBox2d& scraper) : scraper_(scraper) {}

  void begin(const world::World& world);
  void begin_mission(Time now);
  void see(const world::GroundTruth& truth);

  /// All heaps: those that were covered in the order of that, then the others. Collisions and
  /// metres after the last one count for the last row.
  [[nodiscard]] std::vector<CleanedHeap> heaps() const;
  [[nodiscard]] double mission_time() const;

 private:
  [[nodiscard]] bool covers(const world::Heap& heap, const Pose2& before, const Pose2& after) const;
  [[nodiscard]] double seconds_of_mission(Time now) const;

  Eigen::AlignedBox2d scraper_;
  std::vector<world::Heap> waiting_;
  std::vector<CleanedHeap> covered_;
  CleanedHeap open_;  ///< what has happened since the last heap was covered
  std::optional<Time> begun_;
  std::optional<world::GroundTruth> truth_;
};

}  // namespace coop::referee
