#pragma once
#include <coop_msgs/msg/GroundTruth.h>
#include <coop_msgs/msg/MissionStatus.h>
#include <coop_msgs/msg/NavigationStatus.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "core/robot/robot_model.hpp"
#include "referee/cleaning.hpp"
#include "referee/legs.hpp"
#include "referee/referee.hpp"
#include "runtime/node.hpp"
#include "runtime/stamped_queue.hpp"

namespace coop::referee {

struct RefereeNodeConfig {
  std::string robot = "config/robot/egg_collector.urdf";
  std::string file = "attempts.csv";     ///< in the run's folder
  std::string legs_file = "legs.csv";    ///< in the run's folder
  std::string heaps_file = "heaps.csv";  ///< in the run's folder, of a robot that cleans
  double goal_radius = 0.7;              ///< m; a goal of a leg is reached within
  double time_limit = 0.0;               ///< s of mission, then the run is over; 0: none
  RefereeConfig referee;

  void describe(config::Fields& fields);
};

/// Judges the attempts of a simulated mission and measures its drives, one row of a file each, and
/// ends with the mission.
class RefereeNode {
 public:
  using Config = RefereeNodeConfig;
  static void check(const Config& config);
  RefereeNode(runtime::Node& node, const Config& config);

 private:
  RefereeNode(runtime::Node& node, const Config& config, const robot::RobotModel& robot);
  void subscribe();
  void receive(const coop_msgs::msg::GroundTruth& message);
  void receive(const coop_msgs::msg::MissionStatus& message);
  void receive(const coop_msgs::msg::NavigationStatus& message);
  void step();
  void end();
  void write_finished();
  void write_heaps();

  /// A file of the run that grows by rows.
  struct Table {
    Table(const std::filesystem::path& path, const std::vector<std::string>& columns);
    void add(const std::vector<std::string>& row);
    std::filesystem::path path;
    std::ofstream out;
    int rows = 0;
  };

  runtime::Node& node_;
  Config config_;
  Referee referee_;
  Legs legs_;
  const TransformBuffer& transforms_;
  struct Moment {
    Time stamp;
    Pose2 robot_in_world;
  };
  runtime::StampedQueue<Moment> moments_;
  Table attempts_;
  Table leg_table_;
  std::optional<Cleaning> cleaning_;  ///< of a robot with a scraper
  std::optional<Table> heap_table_;   ///< written when the mission is over
  Time mission_begun_{};
};

}  // namespace coop::referee
