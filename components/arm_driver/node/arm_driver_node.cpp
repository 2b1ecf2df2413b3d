#include "arm_driver/node/arm_driver_node.hpp"

#include <array>
#include <system_error>

#include "arm_driver/simulated_arm.hpp"
#include "conversions/geometry.hpp"
#include "conversions/sensors.hpp"
#include "conversions/time.hpp"
#include "conversions/world.hpp"
#include "core/atomic_file.hpp"
#include "core/joint_state.hpp"

namespace coop::arm_driver {
namespace {

using runtime::Qos;

constexpr auto kTick = std::chrono::milliseconds(20);
// Each how many ticks:
constexpr std::uint64_t kJointStates = 2;    // 25 Hz
constexpr std::uint64_t kLinks = 5;          // 10 Hz
constexpr std::uint64_t kIdleGripper = 10;   // 5 Hz
constexpr std::uint64_t kJournalRetry = 25;  // 2 Hz, while it cannot be written
constexpr std::array<std::string_view, 1> kBackends{"sim"};

/// Frames fixed to the robot that no other component tells of.
constexpr std::array kFixedFrames{robot::kArmBaseLink, robot::kBasketLink, robot::kWorkingPoint};

std::vector<double> to_list(const JointVector& values) {
  return {values.data(), values.data() + values.size()};
}

}  // namespace

void ArmDriverConfig::describe(config::Fields& fields) {
  fields.text("robot", robot, {.help = "URDF of the robot"});
  fields.choice("backend", backend, kBackends, {.help = "what stands behind the driver"});
  fields.text("journal", journal, {.help = "file of the picks, in the run's folder; empty: none"});
  fields.text("memory", memory, {.help = "file of the simulated arm's posture, likewise"});
  fields.section("orders", orders);
  fields.section("motion", motion);
  fields.section("pick", pick);
}

void ArmDriverNode::check(const Config& config) {
  (void)ArmMotion(robot::RobotModel::load(config.robot), config.motion);
}

ArmDriverNode::ArmDriverNode(runtime::Node& node, const Config& config)
    : node_(node),
      config_(config),
      motion_(robot::RobotModel::load(config.robot), config.motion),
      sequence_(std::make_unique<PickSequence>(config.pick, motion_, load_record())),
      joint_names_(motion_.chain().names()) {
  result_ = node.advertise<coop_msgs::msg::PickResult>("pick_result", Qos::kEvent);
  gripper_ = node.advertise<coop_msgs::msg::GripperState>("gripper", Qos::kSensorStream);
  joints_ = node.advertise<sensor_msgs::msg::JointState>("joint_states", Qos::kSensorStream);
  description_ = node.advertise<std_msgs::msg::String>("robot_description", Qos::kStateLatched);
  transforms_ = node.advertise<tf2_msgs::msg::TFMessage>("tf", Qos::kEvent);
  announce(robot::RobotModel::load(config.robot));
  inbox_ = std::make_unique<PickInbox>(
      config.orders, node.transforms(),
      [this](std::string_view pick_id) { return sequence_->knows(pick_id); });
  subscribe();
  open_device();
  node.every(kTick, [this] { tick(); });
}

PickRecord ArmDriverNode::load_record() {
  if (config_.journal.empty()) return {};
  const auto path = node_.options().run_dir / config_.journal;
  if (!std::filesystem::exists(path)) return {};
  auto record = parse_pick_record(read_file(path));
  if (record) return *std::move(record);
  node_.log().warning("{} {}: starts with an empty one", path.string(), record.error());
  return {};
}

void ArmDriverNode::open_device() {
  // One backend so far; one of real hardware becomes another branch here.
  const auto memory =
      config_.memory.empty() ? std::filesystem::path() : node_.options().run_dir / config_.memory;
  auto arm = std::make_unique<SimulatedArm>(motion_.chain(), motion_.home(), memory);
  node_.subscribe<coop_msgs::msg::GroundTruth>(
      "ground_truth", Qos::kSensorStream,
      [this, arm = arm.get()](const coop_msgs::msg::GroundTruth& message) {
        const auto truth = conversions::from_msg(message);
        if (!truth) return;
        bool held = false;
        for (const world::Egg& egg : truth->eggs) {
          held = held || egg.state == world::EggState::kInGripper;
        }
        arm->hear_truth(held, node_.now());
      },
      runtime::Attention::kPatient);
  device_ = std::move(arm);
}

void ArmDriverNode::subscribe() {
  node_.subscribe<coop_msgs::msg::EmergencyStop>(
      "emergency_stop", Qos::kStateLatched, [this](const coop_msgs::msg::EmergencyStop& message) {
        const bool before = stops_.engaged();
        stops_.set(message.source(), message.engaged(), message.reason());
        if (stops_.engaged() == before) return;
        node_.log().warning("emergency stop {}", before ? "released" : stops_.description());
      });
  node_.subscribe<coop_msgs::msg::Pick>(
      "pick", Qos::kEvent, [this](const coop_msgs::msg::Pick& message) { receive(message); });
}

void ArmDriverNode::announce(const robot::RobotModel& model) {
  std_msgs::msg::String text;
  text.data(model.urdf());
  description_.publish(text);
  for (const std::string_view frame : kFixedFrames) {
    if (!model.has_link(frame)) continue;
    node_.publish_static_transform(robot::kBaseLink, frame, model.mount(frame));
  }
  for (const robot::Joint& joint : motion_.chain().joints()) {
    if (joint.is_movable()) {
      links_.push_back({Time{}, joint.parent, joint.child, joint.origin});
    } else {
      node_.publish_static_transform(joint.parent, joint.child, joint.origin);
    }
  }
}

void ArmDriverNode::receive(const coop_msgs::msg::Pick& message) {
  if (message.pick_id().empty()) {
    node_.log().warning("refused a pick without pick_id");
    return;
  }
  if (!sequence_->knows(message.pick_id())) {
    node_.log().info("pick {} of egg {} at ({:.3f}, {:.3f}) in {}", message.pick_id(),
                     message.egg_id(), message.position().x(), message.position().y(),
                     message.header().frame_id());
  }
  inbox_->receive(message, node_.now());
}

void ArmDriverNode::tick() {
  const Time now = node_.now();
  const ArmReading reading = device_->read(now);
  const ArmOutputs& outputs = sequence_->step(
      {reading.positions, reading.suction, reading.vacuum, stops_.engaged(), inbox_->take(now)},
      now);
  const bool is_retried = journal_fails_ && ticks_ % kJournalRetry == 0;
  if (outputs.record_changed || is_retried) save_record();
  device_->command(outputs.target, outputs.suction, now);
  for (const PickReport& report : outputs.reports) tell(report);
  publish_state(device_->read(now), outputs.busy);
  report_health(reading);
  ++ticks_;
}

void ArmDriverNode::save_record() {
  if (config_.journal.empty()) return;
  try {
    write_file_atomically(node_.options().run_dir / config_.journal, to_text(sequence_->record()));
    journal_fails_ = false;
  } catch (const std::system_error& problem) {
    if (!journal_fails_) node_.log().error("{}", problem.what());
    journal_fails_ = true;
  }
}

void ArmDriverNode::publish_state(const ArmReading& reading, bool busy) {
  const Time now = node_.now();
  if (busy || ticks_ % kIdleGripper == 0) {
    coop_msgs::msg::GripperState gripper;
    gripper.header(conversions::to_header(now, std::string(robot::kBaseLink)));
    gripper.suction(reading.suction);
    gripper.vacuum_kpa(reading.vacuum_kpa);
    gripper.tip(conversions::to_msg(motion_.chain().tip_in_reference(reading.positions)));
    gripper_.publish(gripper);
  }
  if (ticks_ % kJointStates == 0) {
    joints_.publish(conversions::to_msg(JointState{
        now, joint_names_, to_list(reading.positions), to_list(reading.velocities), {}}));
  }
  // Once at the start, so that the frames exist; then only while they move.
  if (ticks_ == 0 || (busy && ticks_ % kLinks == 0)) publish_links(reading);
}

void ArmDriverNode::publish_links(const ArmReading& reading) {
  const auto poses = motion_.chain().child_in_parent(reading.positions);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    links_[i].stamp = node_.now();
    links_[i].child_in_parent = poses[i];
  }
  transforms_.publish(conversions::to_msg(links_));
}

void ArmDriverNode::tell(const PickReport& report) {
  node_.log().info("pick {}: {}{}{}", report.pick_id, to_string(report.outcome),
                   report.detail.empty() ? "" : ", ", report.detail);
  coop_msgs::msg::PickResult message;
  message.header(conversions::to_header(node_.now(), std::string(robot::kBaseLink)));
  message.pick_id(report.pick_id);
  message.egg_id(report.egg_id);
  message.result(static_cast<std::uint8_t>(report.outcome));
  message.detail(report.detail);
  result_.publish(message);
}

void ArmDriverNode::report_health(const ArmReading& reading) {
  const Time now = node_.now();
  if (reading.vacuum || vacuum_read_ == Time{} || now < vacuum_read_) vacuum_read_ = now;
  if (journal_fails_) {
    node_.set_degraded("the journal of the picks cannot be written");
  } else if (now - vacuum_read_ > std::chrono::seconds(1)) {
    node_.set_degraded("no reading of the vacuum: no ground_truth comes");
  } else {
    node_.set_ready();
  }
}

}  // namespace coop::arm_driver
