#include "lidar_driver/node/lidar_driver_node.hpp"

#include <array>
#include <stdexcept>

#include "core/carmen/carmen_log.hpp"
#include "core/config/error.hpp"
#include "core/robot/robot_model.hpp"
#include "lidar_driver/node/log_backend.hpp"
#include "lidar_driver/node/simulation_backend.hpp"

namespace coop::lidar_driver {
namespace {

constexpr std::array<std::string_view, 2> kBackends = {"sim", "log"};

ScanLog load_log(const LogConfig& config) {
  if (config.file.empty()) {
    throw config::Error("log.file: expected a CARMEN log for backend 'log'");
  }
  const auto records = carmen::read_log(config.file);
  try {
    return {records, config.section, std::string(robot::kLaserLink)};
  } catch (const std::runtime_error& problem) {
    throw config::Error(config.file + ": " + problem.what());
  }
}

}  // namespace

void SimulationConfig::describe(config::Fields& fields) {
  fields.number("rate", rate,
                {.unit = "Hz", .help = "scans a second of simulated time", .min = 0.1, .max = 50});
  fields.section("lidar", lidar);
}

void MountConfig::describe(config::Fields& fields) {
  fields.number("x", x, {.unit = "m", .help = "laser_link in base_link"});
  fields.number("y", y, {.unit = "m", .help = "laser_link in base_link"});
  fields.number("yaw", yaw,
                {.unit = "rad", .help = "of laser_link in base_link", .min = -6.3, .max = 6.3});
}

void LogConfig::describe(config::Fields& fields) {
  fields.text("file", file, {.help = "CARMEN log"});
  fields.section("section", section);
  fields.section("mount", mount);
  fields.integer("readers", readers,
                 {.unit = "1", .help = "start when so many hear the scans", .min = 1, .max = 50});
  fields.number(
      "settle", settle,
      {.unit = "s", .help = "between that and the start, wall time", .min = 0, .max = 60});
  fields.flag("resume", resume, {.help = "go on where an earlier life of this run was killed"});
  fields.number("patience", patience,
                {.unit = "s",
                 .help = "that readers may take to acknowledge the end, wall time",
                 .min = 0,
                 .max = 3600});
}

void LidarDriverConfig::describe(config::Fields& fields) {
  fields.choice("backend", backend, kBackends, {.help = "where scans come from"});
  fields.text("robot", robot, {.help = "URDF of the robot (sim)"});
  fields.section("sim", sim);
  fields.section("log", log);
}

void LidarDriverNode::check(const Config& config) {
  if (config.backend == "log") {
    (void)load_log(config.log);
  } else {
    (void)robot::RobotModel::load(config.robot).mount(robot::kLaserLink);
  }
}

LidarDriverNode::LidarDriverNode(runtime::Node& node, const Config& config) {
  if (config.backend == "log") {
    backend_ = std::make_shared<LogBackend>(node, config.log, load_log(config.log));
  } else {
    backend_ = std::make_shared<SimulationBackend>(
        node, config.sim, robot::RobotModel::load(config.robot).mount(robot::kLaserLink));
  }
}

}  // namespace coop::lidar_driver
