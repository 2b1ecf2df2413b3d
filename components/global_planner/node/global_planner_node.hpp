#pragma once
#include <string>

#include "coop_msgs/msg/MissionStatus.h"
#include "coop_msgs/msg/NavigationStatus.h"
#include "core/robot/robot_model.hpp"
#include "geometry_msgs/msg/PoseStamped.h"
#include "global_planner/global_planner.hpp"
#include "nav_msgs/msg/OccupancyGrid.h"
#include "nav_msgs/msg/Path.h"
#include "runtime/node.hpp"
#include "runtime/stamped_queue.hpp"
#include "vision_msgs/msg/Detection3DArray.h"

namespace coop::global_planner {

struct GlobalPlannerNodeConfig {
  std::string robot = "config/robot/egg_collector.urdf";
  double egg_radius = 0.05;  ///< m around an egg on the floor that is kept clear
  GlobalPlannerConfig planner;

  void describe(config::Fields& fields);
  void validate() const;
};

/// Shell of the global planner. A goal's name is its stamp in nanoseconds; the plan carries the
/// goal's stamp, so that dwa can answer for it. The same goal told again is the same goal; one
/// without a frame takes the goal of its stamp back, one without a stamp as well whichever is in
/// force.
class GlobalPlannerNode {
 public:
  using Config = GlobalPlannerNodeConfig;
  static void check(const Config& config) { (void)robot::RobotModel::load(config.robot); }
  GlobalPlannerNode(runtime::Node& node, const Config& config);

 private:
  void receive_goal(const geometry_msgs::msg::PoseStamped& message);
  void take_back_goal(const geometry_msgs::msg::PoseStamped& message);
  void receive_animals(const vision_msgs::msg::Detection3DArray& message);
  void receive_driver(const coop_msgs::msg::NavigationStatus& message);
  void integrate_scans();
  void update();
  void publish_plan();
  void publish_status();
  void publish_costmap();

  runtime::Node& node_;
  Config config_;
  GlobalPlanner planner_;
  const TransformBuffer& transforms_;
  runtime::StampedQueue<LaserScan> scans_;
  Time goal_stamp_{};
  Time costmap_published_{};
  bool costmap_waits_ = false;
  runtime::Publisher<nav_msgs::msg::Path> plan_publisher_;
  runtime::Publisher<nav_msgs::msg::OccupancyGrid> costmap_publisher_;
  runtime::Publisher<coop_msgs::msg::NavigationStatus> status_publisher_;
};

}  // namespace coop::global_planner
