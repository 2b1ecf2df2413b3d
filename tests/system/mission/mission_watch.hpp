#pragma once
#include <memory>

#include "coop_msgs/msg/GroundTruth.h"
#include "coop_msgs/msg/MissionStatus.h"
#include "runtime/node.hpp"
#include "system/support/listener.hpp"
#include "vision_msgs/msg/Detection3DArray.h"

namespace coop::test {

/// Listens to a running system over DDS, as any other program would.
class MissionWatch {
 public:
  explicit MissionWatch(int domain);
  /// One that only looks, as an observer with keys does.
  explicit MissionWatch(const runtime::DdsOptions& dds);

  /// Takes in what has arrived.
  void look();
  [[nodiscard]] const coop_msgs::msg::MissionStatus& mission() const { return mission_; }
  [[nodiscard]] const coop_msgs::msg::GroundTruth& truth() const { return truth_; }
  [[nodiscard]] int eggs_picked() const;     ///< as the mission tells
  [[nodiscard]] int eggs_collected() const;  ///< as the simulated world has it
  [[nodiscard]] int heaps_cleaned() const;   ///< as the simulated world has it
  [[nodiscard]] bool is_done() const;
  [[nodiscard]] int eggs_missing() const;  ///< as the mission tells

  /// Tells of an egg in the map, as a camera would with three pictures of it.
  void pretend_egg(double x, double y);

 private:
  void subscribe();

  Listener listener_;
  runtime::Publisher<vision_msgs::msg::Detection3DArray> eggs_;
  coop_msgs::msg::MissionStatus mission_;
  coop_msgs::msg::GroundTruth truth_;
};

}  // namespace coop::test
