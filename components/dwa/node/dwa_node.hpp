#pragma once
#include <string>

#include "coop_msgs/msg/DwaCandidates.h"
#include "coop_msgs/msg/NavigationStatus.h"
#include "core/robot/robot_model.hpp"
#include "core/vehicle/command_gate.hpp"
#include "dwa/dwa.hpp"
#include "geometry_msgs/msg/TwistStamped.h"
#include "nav_msgs/msg/OccupancyGrid.h"
#include "nav_msgs/msg/Path.h"
#include "runtime/node.hpp"
#include "runtime/stamped_queue.hpp"
#include "vision_msgs/msg/Detection3DArray.h"

namespace coop::dwa {

struct DwaNodeConfig {
  std::string robot = "config/robot/egg_collector.urdf";
  double egg_radius = 0.05;     ///< m around an egg on the floor that is kept clear
  double picture_period = 0.2;  ///< s between messages for people: local plan, costmap, candidates
  DwaConfig dwa;

  void describe(config::Fields& fields);
};

/// Shell of the local planner: cmd_vel at every control step, also while it stands (zero), and what
/// it is doing as navigation_status. The goal's name is the stamp of the plan, which is that of the
/// goal.
class DwaNode {
 public:
  using Config = DwaNodeConfig;
  static void check(const Config& config) { (void)robot::RobotModel::load(config.robot); }
  DwaNode(runtime::Node& node, const Config& config);

 private:
  DwaNode(runtime::Node& node, const Config& config, const robot::RobotModel& robot);
  void subscribe();
  void receive_plan(const nav_msgs::msg::Path& message);
  void receive_animals(const vision_msgs::msg::Detection3DArray& message);
  void integrate_scans();
  void step();
  void publish_status(const DwaOutput& output);
  void publish_pictures();
  void publish_candidates();

  runtime::Node& node_;
  Config config_;
  vehicle::AckermannGeometry base_;
  Dwa dwa_;
  vehicle::EmergencyStops emergency_stops_;
  const TransformBuffer& transforms_;
  runtime::StampedQueue<LaserScan> scans_;
  DwaInputs inputs_;
  std::optional<DwaOutput> last_output_;
  Time last_status_{};
  Time last_picture_{};
  runtime::Publisher<geometry_msgs::msg::TwistStamped> command_publisher_;
  runtime::Publisher<coop_msgs::msg::NavigationStatus> status_publisher_;
  runtime::Publisher<nav_msgs::msg::Path> plan_publisher_;
  runtime::Publisher<nav_msgs::msg::OccupancyGrid> costmap_publisher_;
  runtime::Publisher<coop_msgs::msg::DwaCandidates> candidates_publisher_;
};

}  // namespace coop::dwa
