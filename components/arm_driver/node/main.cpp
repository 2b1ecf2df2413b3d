#include "arm_driver/node/arm_driver_node.hpp"
#include "runtime/run.hpp"

int main(int argc, char** argv) {
  return coop::runtime::run<coop::arm_driver::ArmDriverNode>(
      argc, argv, "arm_driver", "Arm with suction gripper: picks eggs into the basket");
}
