#include "camera_driver/node/camera_driver_node.hpp"

#include <array>

#include "camera_driver/node/simulation_backend.hpp"
#include "core/robot/robot_model.hpp"

namespace coop::camera_driver {
namespace {

constexpr std::array<std::string_view, 1> kBackends = {"sim"};

}  // namespace

void SimulationConfig::describe(config::Fields& fields) {
  fields.number("rate", rate,
                {.unit = "Hz", .help = "frames a second of simulated time", .min = 0.1, .max = 50});
  fields.section("camera", camera);
}

void CameraDriverConfig::describe(config::Fields& fields) {
  fields.choice("backend", backend, kBackends, {.help = "where pictures come from"});
  fields.text("robot", robot, {.help = "URDF of the robot"});
  fields.section("sim", sim);
  fields.section("detector", detector);
}

void CameraDriverConfig::validate() const {
  sim.camera.validate();
  detector.validate();
}

void CameraDriverNode::check(const Config& config) {
  (void)robot::RobotModel::load(config.robot).mount(robot::kCameraOpticalFrame);
}

CameraDriverNode::CameraDriverNode(runtime::Node& node, const Config& config) {
  backend_ =
      std::make_shared<SimulationBackend>(node, config, robot::RobotModel::load(config.robot));
}

}  // namespace coop::camera_driver
