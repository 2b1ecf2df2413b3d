#pragma once
#include <coop_msgs/msg/EmergencyStop.h>
#include <coop_msgs/msg/GripperState.h>
#include <coop_msgs/msg/GroundTruth.h>
#include <coop_msgs/msg/World.h>
#include <geometry_msgs/msg/TwistStamped.h>
#include <nav_msgs/msg/Odometry.h>
#include <rosgraph_msgs/msg/Clock.h>
#include <sensor_msgs/msg/Imu.h>

#include <memory>
#include <optional>
#include <string>

#include "core/state_journal.hpp"
#include "runtime/node.hpp"
#include "simulator/simulation.hpp"

namespace coop::simulator {

struct SimulatorConfig {
  std::string world = "maps/duck_house.world.yaml";
  std::string robot = "config/robot/egg_collector.urdf";
  std::string map;        ///< YAML of a map in the place of the world's own; empty: that one
  double rate = 1.0;      ///< simulated seconds a second; 0: as fast as possible
  double duration = 0.0;  ///< s of simulated time after which the simulation ends; 0: never
  std::string journal = "simulator.journal";  ///< in the run's folder; empty: none
  bool resume = true;                         ///< go on from the journal where it is of this world
  SimulationConfig simulation;

  void describe(config::Fields& fields);
};

/// The simulator as a component: master of time, stands in for the chassis driver and owns the
/// world.
class SimulatorNode {
 public:
  using Config = SimulatorConfig;
  /// Throws config::Error where world or robot cannot be used.
  static void check(const Config& config);

  SimulatorNode(runtime::Node& node, const Config& config);

 private:
  void open_journal(const Config& config);
  void subscribe();
  void tick();
  void end_when_over();
  void publish_reading();
  void report();

  runtime::Node& node_;
  world::World world_;
  RobotShape robot_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<StateJournal> journal_;
  std::string record_;
  double duration_;
  vehicle::DriveCause last_cause_ = vehicle::DriveCause::kNoCommand;
  std::uint32_t last_collisions_ = 0;

  runtime::Publisher<rosgraph_msgs::msg::Clock> clock_;
  runtime::Publisher<nav_msgs::msg::Odometry> odom_;
  runtime::Publisher<sensor_msgs::msg::Imu> imu_;
  runtime::Publisher<coop_msgs::msg::GroundTruth> ground_truth_;
  runtime::Publisher<coop_msgs::msg::World> world_publisher_;
};

}  // namespace coop::simulator
