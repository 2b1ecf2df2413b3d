#pragma once
#include <functional>

#include "core/world/state.hpp"
#include "runtime/node.hpp"

namespace coop::runtime {

/// The simulated world, as a driver's simulation backend follows it: topics `world` and
/// `ground_truth` in, moments to measure at out. Lives as long as the node.
///
/// It speaks for the driver's health: degraded while there is no world, or no ground truth for
/// 0.5 s. Messages that are refused are told in the log and change nothing.
class WorldFeed {
 public:
  struct Handlers {
    std::function<void(const world::World&)> world;  ///< a new world; forget the one before
    /// The first ground truth at or after each multiple of the period; not before a world came.
    std::function<void(const world::GroundTruth&)> measure;
  };

  /// `rate`: measurements a second of simulated time, Hz.
  WorldFeed(Node& node, double rate, Handlers handlers);
  WorldFeed(const WorldFeed&) = delete;
  WorldFeed& operator=(const WorldFeed&) = delete;

  [[nodiscard]] Duration period() const { return period_; }

 private:
  void receive(const world::GroundTruth& truth);
  void check_freshness();

  Node& node_;
  Duration period_;
  Handlers handlers_;
  bool has_world_ = false;
  std::int64_t last_turn_ = -1;  ///< number of the period of the last measurement
  Time last_truth_{};
};

}  // namespace coop::runtime
