#pragma once
#include <map>

#include "coop_msgs/msg/Mission.h"
#include "coop_msgs/msg/MissionStatus.h"
#include "coop_msgs/msg/NavigationStatus.h"
#include "coop_msgs/msg/Pick.h"
#include "core/detection.hpp"
#include "core/intrinsics.hpp"
#include "core/robot/robot_model.hpp"
#include "core/stamped.hpp"
#include "geometry_msgs/msg/PoseStamped.h"
#include "runtime/node.hpp"
#include "runtime/stamped_queue.hpp"
#include "sequencer/journal.hpp"
#include "sequencer/sequencer.hpp"
#include "vision_msgs/msg/Detection3DArray.h"

namespace coop::sequencer {

/// Shell of the sequencer: sightings into the map frame, answers of navigators and arm to the
/// mission, its orders out, its state to the journal before anything is ordered.
class SequencerNode {
 public:
  using Config = SequencerConfig;
  static void check(const Config& config);
  SequencerNode(runtime::Node& node, const Config& config);

 private:
  SequencerNode(runtime::Node& node, const Config& config, const robot::RobotModel& robot);

  [[nodiscard]] bool can_do(std::uint8_t kind) const;
  void receive_mission(const coop_msgs::msg::Mission& message);
  void receive_eggs(const vision_msgs::msg::Detection3DArray& message);
  void receive_navigation(const coop_msgs::msg::NavigationStatus& message);
  void look_at_sightings();
  void step();
  void autostart();
  void carry_out(const MissionActions& actions);
  void publish_status();

  runtime::Node& node_;
  Config config_;
  bool cleans_;  ///< heaps of manure, instead of collecting eggs
  Sequencer sequencer_;
  Journal journal_;
  const TransformBuffer& transforms_;
  runtime::StampedQueue<Stamped<std::vector<Detection>>> waiting_;
  std::optional<Stamped<Intrinsics>> camera_;            ///< the last calibration told
  std::map<std::int64_t, NavigationReport> navigation_;  ///< by goal id, a stamp in nanoseconds
  std::optional<PickReport> pick_;
  std::optional<MissionActions> unwritten_;  ///< held back until the journal takes the state
  std::string logged_;                       ///< the last line about the mission
  Time last_status_{};
  runtime::Publisher<geometry_msgs::msg::PoseStamped> goal_publisher_;
  runtime::Publisher<coop_msgs::msg::Pick> pick_publisher_;
  runtime::Publisher<coop_msgs::msg::MissionStatus> status_publisher_;
};

}  // namespace coop::sequencer
