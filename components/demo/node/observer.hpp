#pragma once
#include <optional>

#include "coop_msgs/msg/GroundTruth.h"
#include "coop_msgs/msg/MissionStatus.h"
#include "coop_msgs/msg/World.h"
#include "demo/record.hpp"
#include "runtime/node.hpp"
#include "runtime/stamped_queue.hpp"
#include "sensor_msgs/msg/Image.h"

namespace coop::demo {

/// What a demo wants to be watched.
struct Watch {
  bool map_is_world = false;  ///< the map was drawn in the world's frame, not made by the robot
  bool pictures = false;      ///< the camera's first and last
};

/// Listens to a running system and keeps what the report needs. It never publishes.
class Observer {
 public:
  explicit Observer(runtime::Node& node, const Watch& watch = {});

  [[nodiscard]] const Record& record() const { return record_; }
  [[nodiscard]] bool mission_ended() const {
    return record_.mission_state == "done" || record_.mission_state == "failed";
  }
  /// One line for a person.
  [[nodiscard]] std::string progress() const;

 private:
  struct Truth {
    Time stamp;
    Pose2 robot_in_world;
  };
  void receive(const coop_msgs::msg::GroundTruth& truth);
  void receive(const coop_msgs::msg::World& world);
  void receive(const coop_msgs::msg::MissionStatus& status);
  void receive(const sensor_msgs::msg::Image& picture);
  void note_pen(const coop_msgs::msg::GroundTruth& truth);
  void match_track();

  runtime::Node& node_;
  Watch watch_;
  const TransformBuffer& transforms_;
  runtime::StampedQueue<Truth> waiting_;
  std::optional<Pose2> world_in_map_;
  Time last_track_{};
  Record record_;
};

}  // namespace coop::demo
