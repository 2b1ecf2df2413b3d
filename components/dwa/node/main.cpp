#include "dwa/node/dwa_node.hpp"
#include "runtime/run.hpp"

int main(int argc, char** argv) {
  return coop::runtime::run<coop::dwa::DwaNode>(
      argc, argv, "dwa", "Local planner: dynamic window approach for the Ackermann base");
}
