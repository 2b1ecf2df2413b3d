#include "chassis_driver/node/chassis_driver_node.hpp"
#include "runtime/run.hpp"

int main(int argc, char** argv) {
  return coop::runtime::run<coop::chassis_driver::ChassisDriverNode>(
      argc, argv, "chassis_driver", "Drives the base, or plays the odometry of a recorded log");
}
