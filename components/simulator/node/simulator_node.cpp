#include "simulator/node/simulator_node.hpp"

#include <filesystem>

#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "conversions/time.hpp"
#include "conversions/world.hpp"
#include "core/config/config.hpp"
#include "core/map/map_file.hpp"
#include "simulator/placement.hpp"
#include "simulator/world_description.hpp"

namespace coop::simulator {
namespace {

using runtime::Qos;

/// Everything that comes from files.
struct Scenery {
  WorldDescription description;
  RobotShape robot;
  world::World world;
  std::vector<AnimalDescription> animals;
};

Scenery load(const SimulatorConfig& config, std::uint64_t seed) {
  Scenery scenery;
  scenery.robot = shape_of(robot::RobotModel::load(config.robot));
  scenery.description = config::Document::load(config.world).read<WorldDescription>();
  const auto map_path = config.map.empty() ? std::filesystem::path(config.world).parent_path() /
                                                 scenery.description.map
                                           : std::filesystem::path(config.map);
  scenery.description.map = std::filesystem::absolute(map_path).lexically_normal();
  scenery.world =
      build_world(scenery.description, map::load_map(scenery.description.map), scenery.robot, seed);
  scenery.animals = place_animals(scenery.description, scenery.world, scenery.robot);
  return scenery;
}

}  // namespace

void SimulatorConfig::describe(config::Fields& fields) {
  fields.text("world", world, {.help = "world file, *.world.yaml"});
  fields.text("map", map, {.help = "map YAML in the place of the world's own; empty: that"});
  fields.text("robot", robot, {.help = "URDF of the robot"});
  fields.number("rate", rate,
                {.unit = "s/s",
                 .help = "simulated seconds a second; 0: as fast as possible",
                 .min = 0,
                 .max = 1000});
  fields.number(
      "duration", duration,
      {.unit = "s", .help = "simulated time after which the simulation ends; 0: never", .min = 0});
  fields.text("journal", journal, {.help = "file of the state, in the run's folder; empty: none"});
  fields.flag("resume", resume, {.help = "go on from the journal where it is of this world"});
  fields.section("simulation", simulation);
}

void SimulatorNode::check(const Config& config) {
  (void)load(config, 1);
}

SimulatorNode::SimulatorNode(runtime::Node& node, const Config& config)
    : node_(node), duration_(config.duration) {
  Scenery scenery = load(config, node.options().seed);
  world_ = std::move(scenery.world);
  robot_ = std::move(scenery.robot);
  simulation_ = std::make_unique<Simulation>(config.simulation, robot_, world_, scenery.animals);
  open_journal(config);

  clock_ = node.advertise<rosgraph_msgs::msg::Clock>("clock", Qos::kEvent);
  odom_ = node.advertise<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
  imu_ = node.advertise<sensor_msgs::msg::Imu>("imu", Qos::kSensorStream);
  ground_truth_ = node.advertise<coop_msgs::msg::GroundTruth>("ground_truth", Qos::kSensorStream);
  world_publisher_ = node.advertise<coop_msgs::msg::World>("world", Qos::kStateLatched);
  world_publisher_.publish(conversions::to_msg(world_, simulation_->now()));
  node.advertise_transforms();
  node.publish_static_transform(robot::kBaseLink, robot::kImuLink, robot_.imu_in_base);
  subscribe();
  node.lead_time({.period = Simulation::kTick, .rate = config.rate, .step = [this] {
                    tick();
                    return simulation_->now();
                  }});
}

void SimulatorNode::open_journal(const Config& config) {
  if (config.journal.empty()) return;
  const std::filesystem::path path = node_.options().run_dir / config.journal;
  const auto stored = config.resume ? StateJournal::newest(path) : std::nullopt;
  if (stored) {
    try {
      simulation_->restore(*stored);
      node_.log().info("goes on at {:.2f} s of simulated time", to_seconds(simulation_->now()));
    } catch (const std::runtime_error& problem) {
      node_.log().warning("starts anew: {}", problem.what());
    }
  }
  record_.clear();
  simulation_->store(record_);
  journal_ = std::make_unique<StateJournal>(path, record_.size());
  last_collisions_ = simulation_->ground_truth().collision_count;
}

void SimulatorNode::subscribe() {
  node_.subscribe<geometry_msgs::msg::TwistStamped>(
      "cmd_vel", Qos::kCommand, [this](const geometry_msgs::msg::TwistStamped& message) {
        const auto command = conversions::from_msg(message);
        if (command && simulation_->gate().accept(command->value, simulation_->now())) return;
        if (node_.log().is_due("cmd_vel", seconds(5))) {
          node_.log().warning("refused a velocity command: {}",
                              command ? "not finite" : command.error());
        }
      });
  node_.subscribe<coop_msgs::msg::EmergencyStop>(
      "emergency_stop", Qos::kStateLatched, [this](const coop_msgs::msg::EmergencyStop& message) {
        simulation_->gate().emergency_stops().set(message.source(), message.engaged(),
                                                  message.reason());
      });
  node_.subscribe<coop_msgs::msg::GripperState>(
      "gripper", Qos::kSensorStream, [this](const coop_msgs::msg::GripperState& message) {
        const auto tip = conversions::pose3_from_msg(message.tip());
        if (tip) simulation_->set_gripper({message.suction(), tip->translation()});
      });
}

void SimulatorNode::tick() {
  simulation_->step();
  if (journal_) {
    record_.clear();
    simulation_->store(record_);
    journal_->write(record_);
  }
  // The clock first: who hears of a reading should know that its time has come.
  clock_.publish(conversions::to_clock_msg(simulation_->now()));
  imu_.publish(conversions::to_msg(simulation_->imu()));
  if (simulation_->has_new_reading()) publish_reading();
  report();
  end_when_over();
}

void SimulatorNode::end_when_over() {
  if (duration_ > 0.0 && simulation_->now() - Simulation::kStart >= seconds(duration_)) {
    node_.finish("simulated " + std::to_string(duration_) + " s");
  }
}

void SimulatorNode::publish_reading() {
  const vehicle::WheelOdometry& wheels = simulation_->odometry();
  conversions::FramedOdometry odometry;
  odometry.odometry = wheels.odometry();
  odometry.covariance = wheels.covariance();
  node_.publish_transform(odometry.frame_id, odometry.child_frame_id, odometry.odometry.stamp,
                          odometry.odometry.base_in_odom);
  odom_.publish(conversions::to_msg(odometry));
  ground_truth_.publish(conversions::to_msg(simulation_->ground_truth()));
}

void SimulatorNode::report() {
  const auto cause = simulation_->setpoint().cause;
  if (cause != last_cause_) {
    node_.log().info("{:.2f} s: drives by {}", to_seconds(simulation_->now()), to_string(cause));
    last_cause_ = cause;
  }
  const world::GroundTruth& truth = simulation_->ground_truth();
  if (truth.collision_count != last_collisions_) {
    node_.log().warning("{:.2f} s: collision {} at ({:.2f}, {:.2f})", to_seconds(truth.stamp),
                        truth.collision_count, truth.robot_in_world.x, truth.robot_in_world.y);
    last_collisions_ = truth.collision_count;
  }
}

}  // namespace coop::simulator
