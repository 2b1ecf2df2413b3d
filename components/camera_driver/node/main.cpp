#include "camera_driver/node/camera_driver_node.hpp"
#include "runtime/run.hpp"

int main(int argc, char** argv) {
  return coop::runtime::run<coop::camera_driver::CameraDriverNode>(
      argc, argv, "camera_driver", "Pictures, depth and the eggs seen in them");
}
