#include "runtime/run.hpp"
#include "simulator/node/simulator_node.hpp"

int main(int argc, char** argv) {
  return coop::runtime::run<coop::simulator::SimulatorNode>(
      argc, argv, "simulator",
      "Simulated world with an Ackermann robot: stands in for the chassis driver");
}
