#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"
#include "core/world/state.hpp"

namespace coop::demo {

/// What became of one target, an egg or a heap of manure, as the mission tells it.
struct TargetRecord {
  std::string id;
  Eigen::Vector2d place_in_map{0, 0};
  std::string state;  ///< "picked" or "cleaned", "failed", ...
  int attempts = 0;
  std::string reason;  ///< of a failure
};

/// Whether the mission says that it has got what it wanted.
[[nodiscard]] inline bool is_done(const TargetRecord& target) {
  return target.state == "picked" || target.state == "cleaned";
}

/// The robot at one time: where it was and where it thought it was.
struct TrackPoint {
  Time stamp{};
  Pose2 truth_in_map;
  Pose2 estimate_in_map;
};

/// Everything the report tells of one run, gathered from the topics. The truth is the simulator's,
/// brought into the map frame.
struct Record {
  OccupancyGrid map;
  /// nav2's percentages: 100 lethal, 99 inscribed, 1 to 98 restricted, 0 free, -1 unknown.
  OccupancyGrid costmap;
  std::vector<TrackPoint> track;  ///< ordered by stamp
  std::vector<TargetRecord> targets;
  std::vector<std::string> order;  ///< ids in the order the colony chose
  double tour_cost = 0.0;          ///< m, as ordered
  std::uint32_t collisions = 0;
  std::uint32_t animal_collisions = 0;  ///< of these, with an animal
  int targets_in_world = 0;             ///< or heaps
  int targets_taken = 0;                ///< or heaps cleaned, by the simulator's count
  std::vector<world::Heap> heaps;       ///< as they lie at last, in map
  std::vector<std::vector<Eigen::Vector2d>> animal_tracks;  ///< in map
  std::vector<double> animal_radii;                         ///< m, of the same
  std::string mission_state;
  std::string mission_detail;
  cv::Mat first_view;  ///< pictures of the camera, blue, green, red; where it was asked for them
  cv::Mat last_view;
};

}  // namespace coop::demo
