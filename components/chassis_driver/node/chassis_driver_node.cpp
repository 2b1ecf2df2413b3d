#include "chassis_driver/node/chassis_driver_node.hpp"

#include <array>
#include <stdexcept>

#include "chassis_driver/node/drive_backend.hpp"
#include "chassis_driver/node/log_backend.hpp"
#include "core/carmen/carmen_log.hpp"
#include "core/config/error.hpp"
#include "core/robot/robot_model.hpp"

namespace coop::chassis_driver {
namespace {

constexpr std::array<std::string_view, 2> kBackends = {"loopback", "log"};
constexpr std::array<std::string_view, 2> kEnds = {"finish", "stay"};

OdometryLog load_log(const ChassisDriverConfig& config) {
  if (config.log.file.empty()) {
    throw config::Error("log.file: expected a CARMEN log for backend 'log'");
  }
  try {
    return OdometryLog(carmen::read_log(config.log.file));
  } catch (const carmen::FormatError&) {
    throw;  // names the file and line
  } catch (const std::system_error&) {
    throw;  // names the file
  } catch (const std::runtime_error& problem) {
    throw config::Error(config.log.file + ": " + problem.what());
  }
}

}  // namespace

void LogConfig::describe(config::Fields& fields) {
  fields.text("file", file, {.help = "CARMEN log"});
  fields.section("playback", playback);
  fields.integer(
      "readers", readers,
      {.unit = "1", .help = "start when so many hear clock and odom", .min = 0, .max = 50});
  fields.number(
      "settle", settle,
      {.unit = "s", .help = "between that and the start, wall time", .min = 0, .max = 60});
  fields.flag("resume", resume, {.help = "go on where an earlier life of this run was killed"});
  fields.choice("at_end", at_end, kEnds,
                {.help = "the program ends, or tells the log's last time until it is stopped"});
  fields.number("patience", patience,
                {.unit = "s",
                 .help = "that readers may take to acknowledge the end, wall time",
                 .min = 0,
                 .max = 3600});
}

void ChassisDriverConfig::describe(config::Fields& fields) {
  fields.choice("backend", backend, kBackends,
                {.help = "what moves: nothing real, or a recorded log"});
  fields.text("robot", robot, {.help = "URDF of the robot (loopback)"});
  fields.number(
      "rate", rate,
      {.unit = "Hz", .help = "control cycle and odometry (loopback)", .min = 1, .max = 1000});
  fields.section("chassis", chassis);
  fields.section("log", log);
}

void ChassisDriverNode::check(const Config& config) {
  if (config.backend == "log") {
    (void)load_log(config);
  } else {
    (void)robot::RobotModel::load(config.robot).ackermann();
  }
}

ChassisDriverNode::ChassisDriverNode(runtime::Node& node, const Config& config) {
  if (config.backend == "log") {
    backend_ = std::make_shared<LogBackend>(node, config.log, load_log(config));
  } else {
    backend_ = std::make_shared<DriveBackend>(node, config,
                                              robot::RobotModel::load(config.robot).ackermann());
  }
}

}  // namespace coop::chassis_driver
