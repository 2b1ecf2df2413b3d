#pragma once
#include <coop_msgs/msg/EmergencyStop.h>
#include <coop_msgs/msg/GripperState.h>
#include <coop_msgs/msg/GroundTruth.h>
#include <coop_msgs/msg/Pick.h>
#include <coop_msgs/msg/PickResult.h>
#include <sensor_msgs/msg/JointState.h>
#include <std_msgs/msg/String.h>
#include <tf2_msgs/msg/TFMessage.h>

#include <memory>
#include <string>
#include <vector>

#include "arm_driver/arm_device.hpp"
#include "arm_driver/node/pick_inbox.hpp"
#include "arm_driver/pick_sequence.hpp"
#include "core/stamped.hpp"
#include "core/vehicle/command_gate.hpp"
#include "runtime/node.hpp"

namespace coop::arm_driver {

struct ArmDriverConfig {
  std::string robot = "config/robot/egg_collector.urdf";
  std::string backend = "sim";
  std::string journal = "arm_driver.journal";  ///< in the run's folder; empty: none
  std::string memory = "arm_driver.posture";   ///< of the simulated arm, likewise
  PickInboxConfig orders;
  ArmMotionConfig motion;
  PickSequenceConfig pick;

  void describe(config::Fields& fields);
};

/// The arm as a component: orders come in by `pick`, are answered by `pick_result`.
class ArmDriverNode {
 public:
  using Config = ArmDriverConfig;
  /// Throws config::Error where the robot's arm cannot do what the configuration says.
  static void check(const Config& config);

  ArmDriverNode(runtime::Node& node, const Config& config);

 private:
  [[nodiscard]] PickRecord load_record();
  void open_device();
  void subscribe();
  void announce(const robot::RobotModel& model);
  void receive(const coop_msgs::msg::Pick& message);
  void tick();
  void save_record();
  void publish_state(const ArmReading& reading, bool busy);
  void publish_links(const ArmReading& reading);
  void tell(const PickReport& report);
  void report_health(const ArmReading& reading);

  runtime::Node& node_;
  Config config_;
  ArmMotion motion_;
  std::unique_ptr<ArmDevice> device_;
  std::unique_ptr<PickSequence> sequence_;
  vehicle::EmergencyStops stops_;
  std::unique_ptr<PickInbox> inbox_;
  std::vector<std::string> joint_names_;
  std::vector<StampedTransform> links_;
  std::uint64_t ticks_ = 0;
  Time vacuum_read_{};
  bool journal_fails_ = false;

  runtime::Publisher<coop_msgs::msg::PickResult> result_;
  runtime::Publisher<coop_msgs::msg::GripperState> gripper_;
  runtime::Publisher<sensor_msgs::msg::JointState> joints_;
  runtime::Publisher<std_msgs::msg::String> description_;
  runtime::Publisher<tf2_msgs::msg::TFMessage> transforms_;
};

}  // namespace coop::arm_driver
