#include "lidar_driver/node/lidar_driver_node.hpp"
#include "runtime/run.hpp"

int main(int argc, char** argv) {
  return coop::runtime::run<coop::lidar_driver::LidarDriverNode>(
      argc, argv, "lidar_driver", "Laser scans of a simulated world or of a recorded log");
}
