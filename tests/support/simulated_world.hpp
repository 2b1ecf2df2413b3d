#pragma once
#include <coop_msgs/msg/GroundTruth.h>
#include <coop_msgs/msg/World.h>

#include <optional>

#include "conversions/world.hpp"
#include "core/world/state.hpp"
#include "support/component_fixture.hpp"
#include "support/room.hpp"

namespace coop::test {

/// Stands for the simulator before drivers under test: says `world` and `ground_truth` when told.
class SimulatedWorld {
 public:
  explicit SimulatedWorld(ComponentFixture& fixture) : fixture_(fixture) {}

  world::World world = room(80, 30);
  world::GroundTruth scene;  ///< its stamp is set as it is told

  void publish_world() { publish_world(conversions::to_msg(world, fixture_.now())); }
  void publish_world(const coop_msgs::msg::World& message) {
    if (!world_) {
      world_.emplace(
          fixture_.tester().advertise<coop_msgs::msg::World>("world", runtime::Qos::kStateLatched));
    }
    world_->publish(message);
    fixture_.settle();
  }

  /// Ground truth of the scene at 50 Hz.
  void publish_truth(Duration duration) {
    constexpr Duration kStep = std::chrono::milliseconds(20);
    if (!truth_) {
      truth_.emplace(fixture_.tester().advertise<coop_msgs::msg::GroundTruth>(
          "ground_truth", runtime::Qos::kSensorStream));
    }
    for (Duration done{0}; done < duration; done += kStep) {
      fixture_.advance(kStep);
      scene.stamp = fixture_.now();
      truth_->publish(conversions::to_msg(scene));
      fixture_.settle();
    }
  }

 private:
  ComponentFixture& fixture_;
  std::optional<runtime::Publisher<coop_msgs::msg::World>> world_;
  std::optional<runtime::Publisher<coop_msgs::msg::GroundTruth>> truth_;
};

}  // namespace coop::test
