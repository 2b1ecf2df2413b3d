#include "runtime/run.hpp"
#include "slam/node/slam_node.hpp"

int main(int argc, char** argv) {
  return coop::runtime::run<coop::slam::SlamNode>(
      argc, argv, "slam",
      "Mapping and localisation at once: Rao-Blackwellised particle filter over grids");
}
