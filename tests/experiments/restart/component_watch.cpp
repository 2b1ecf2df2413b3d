#include "experiments/restart/component_watch.hpp"

#include <algorithm>

#include "coop_msgs/msg/MissionStatus.h"
#include "geometry_msgs/msg/TwistStamped.h"
#include "nav_msgs/msg/OccupancyGrid.h"
#include "nav_msgs/msg/Odometry.h"
#include "sensor_msgs/msg/JointState.h"
#include "sensor_msgs/msg/LaserScan.h"
#include "tf2_msgs/msg/TFMessage.h"
#include "vision_msgs/msg/Detection3DArray.h"

namespace coop::experiments {

using coop_msgs::msg::ComponentStatus;
using runtime::Qos;

template <class Message>
void ComponentWatch::prove(const std::string& component, const std::string& topic, Qos qos) {
  listener_.node().subscribe<Message>(
      topic, qos, [this, component](const Message&, const runtime::MessageInfo& info) {
        saw(component, info.writer);
      });
}

ComponentWatch::ComponentWatch(int domain) : listener_(domain, "component_watch") {
  listener_.node().subscribe<ComponentStatus>(
      "component_status", Qos::kHeartbeat, [this](const ComponentStatus& message) {
        Status& status = statuses_[message.name()];
        const auto now = Wall::now();
        const auto pid = static_cast<pid_t>(message.pid());
        if (pid != status.pid || message.state() != status.state) {
          status.since = now;
        }
        status = {pid, message.state(), status.since, now, message.detail()};
      });
  prove<geometry_msgs::msg::TwistStamped>("dwa", "cmd_vel", Qos::kCommand);
  prove<nav_msgs::msg::OccupancyGrid>("global_planner", "global_costmap", Qos::kStateLatched);
  prove<nav_msgs::msg::Odometry>("simulator", "odom", Qos::kSensorStream);
  prove<sensor_msgs::msg::LaserScan>("lidar_driver", "scan", Qos::kSensorStream);
  prove<vision_msgs::msg::Detection3DArray>("camera_driver", "eggs", Qos::kEvent);
  prove<sensor_msgs::msg::JointState>("arm_driver", "joint_states", Qos::kSensorStream);
  prove<coop_msgs::msg::MissionStatus>("sequencer", "mission_status", Qos::kStateLatched);
  // Who says where the robot is.
  listener_.node().subscribe<tf2_msgs::msg::TFMessage>(
      "tf", Qos::kEvent,
      [this](const tf2_msgs::msg::TFMessage& message, const runtime::MessageInfo& info) {
        const auto is_fix = [](const auto& transform) {
          return transform.header().frame_id() == "map";
        };
        if (!std::ranges::any_of(message.transforms(), is_fix)) return;
        saw("amcl", info.writer);
        saw("slam", info.writer);
      });
}

void ComponentWatch::look(std::chrono::milliseconds limit) {
  listener_.wait(limit);
}

void ComponentWatch::saw(const std::string& component, std::string_view writer) {
  const auto now = Wall::now();
  auto& writers = writers_[component];
  const auto found = writers.find(writer);
  if (found == writers.end()) {
    writers.emplace(writer, Seen{now, now});
  } else {
    found->second.last = now;
  }
}

std::optional<ComponentWatch::Status> ComponentWatch::status(const std::string& component) const {
  const auto found = statuses_.find(component);
  if (found == statuses_.end()) return std::nullopt;
  return found->second;
}

bool ComponentWatch::is_ready(const std::string& component) const {
  const auto found = status(component);
  return found && found->state == coop_msgs::msg::ComponentStatus_Constants::READY;
}

std::optional<Wall::time_point> ComponentWatch::successor_at_work(const std::string& component,
                                                                  Wall::time_point since) const {
  const auto found = writers_.find(component);
  if (found == writers_.end()) return std::nullopt;
  std::optional<Wall::time_point> first;
  for (const auto& [writer, seen] : found->second) {
    if (seen.first > since && (!first || seen.first < *first)) first = seen.first;
  }
  return first;
}

std::optional<Wall::time_point> ComponentWatch::last_at_work(const std::string& component) const {
  const auto found = writers_.find(component);
  if (found == writers_.end()) return std::nullopt;
  std::optional<Wall::time_point> last;
  for (const auto& [writer, seen] : found->second)
    last = std::max(last.value_or(seen.last), seen.last);
  return last;
}

}  // namespace coop::experiments
