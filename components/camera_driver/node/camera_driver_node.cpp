#include "camera_driver/node/camera_driver_node.hpp"

#include <array>

#include "camera_driver/node/files_backend.hpp"
#include "camera_driver/node/overhead_backend.hpp"
#include "camera_driver/node/simulation_backend.hpp"
#include "core/robot/robot_model.hpp"

namespace coop::camera_driver {
namespace {

constexpr std::array<std::string_view, 3> kBackends = {"sim", "overhead", "files"};

}  // namespace

void PlacementErrorConfig::describe(config::Fields& fields) {
  fields.number("mount_position", mount_position,
                {.unit = "m",
                 .help = "deviation over runs of the camera's place, each axis",
                 .min = 0,
                 .max = 0.5});
  fields.number("mount_angle", mount_angle,
                {.unit = "rad",
                 .help = "deviation over runs of the camera's direction, about each axis",
                 .min = 0,
                 .max = 0.5});
  fields.number(
      "detection", detection,
      {.unit = "m", .help = "deviation of each detection, each axis", .min = 0, .max = 1});
}

void SimulationConfig::describe(config::Fields& fields) {
  fields.number("rate", rate,
                {.unit = "Hz", .help = "frames a second of simulated time", .min = 0.1, .max = 50});
  fields.section("camera", camera);
  fields.section("errors", errors);
}

void FilesConfig::describe(config::Fields& fields) {
  fields.text("folder", folder, {.help = "of PNG and JPEG pictures"});
  fields.number("period", period,
                {.unit = "s", .help = "between pictures", .min = 0.01, .max = 3600});
  fields.section("photograph", photograph);
}

void OverheadConfig::describe(config::Fields& fields) {
  fields.number("rate", rate,
                {.unit = "Hz", .help = "frames a second of simulated time", .min = 0.1, .max = 50});
  fields.section("mount", mount);
  fields.section("noise", noise);
  fields.section("detector", detector);
}

void CameraDriverConfig::describe(config::Fields& fields) {
  fields.choice("backend", backend, kBackends, {.help = "where pictures come from"});
  fields.text("robot", robot, {.help = "URDF of the robot"});
  fields.section("sim", sim);
  fields.section("detector", detector);
  fields.section("overhead", overhead);
  fields.section("files", files);
}

void CameraDriverConfig::validate() const {
  sim.camera.validate();
  detector.validate();
  overhead.detector.validate();
  files.photograph.validate();
}

void CameraDriverNode::check(const Config& config) {
  if (config.backend == "files") (void)FilesBackend::list(config.files.folder);
  const auto robot = robot::RobotModel::load(config.robot);
  if (config.backend == "overhead") {
    (void)robot.footprint();
  } else {
    (void)robot.mount(robot::kCameraOpticalFrame);
  }
}

CameraDriverNode::CameraDriverNode(runtime::Node& node, const Config& config) {
  const auto robot = robot::RobotModel::load(config.robot);
  if (config.backend == "overhead") {
    backend_ = std::make_shared<OverheadBackend>(node, config, RobotBody{robot.footprint()});
    return;
  }
  node.publish_static_transform(robot::kBaseLink, robot::kCameraLink,
                                robot.mount(robot::kCameraLink));
  node.publish_static_transform(robot::kCameraLink, robot::kCameraOpticalFrame,
                                robot.mount(robot::kCameraOpticalFrame, robot::kCameraLink));
  if (config.backend == "files") {
    backend_ = std::make_shared<FilesBackend>(node, config.files);
  } else {
    backend_ =
        std::make_shared<SimulationBackend>(node, config, robot.mount(robot::kCameraOpticalFrame));
  }
}

}  // namespace coop::camera_driver
