#pragma once
#include <optional>
#include <string>
#include <vector>

#include "coop_msgs/msg/GroundTruth.h"
#include "coop_msgs/msg/MissionStatus.h"
#include "experiments/chaos/judge.hpp"
#include "experiments/restart/component_watch.hpp"
#include "rosgraph_msgs/msg/Clock.h"

namespace coop::chaos {

using experiments::Wall;

/// Watches a system from outside: the truth of the world, the mission, every component's health.
class Observer {
 public:
  explicit Observer(int domain);

  /// Takes in what arrives within `limit`.
  void look(std::chrono::milliseconds limit) { components_.look(limit); }

  [[nodiscard]] const experiments::ComponentWatch& components() const { return components_; }
  [[nodiscard]] const coop_msgs::msg::MissionStatus& mission() const { return mission_; }
  [[nodiscard]] const coop_msgs::msg::GroundTruth& truth() const { return truth_; }
  /// s of simulated time, as the newest truth has it; 0 before the first.
  [[nodiscard]] double simulated() const;
  [[nodiscard]] bool is_over() const;
  /// The robot's motion since `begin`, s of simulated time.
  [[nodiscard]] std::vector<Motion> motion_since(double begin) const;

  /// One sample of /clock that is off by `offset` s, as from a second master of time.
  void tell_wrong_time(double offset);

 private:
  experiments::ComponentWatch components_;
  runtime::Publisher<rosgraph_msgs::msg::Clock> clock_;
  coop_msgs::msg::MissionStatus mission_;
  coop_msgs::msg::GroundTruth truth_;
  std::deque<Motion> motion_;
  double gone_ = 0.0;  ///< m
};

}  // namespace coop::chaos
