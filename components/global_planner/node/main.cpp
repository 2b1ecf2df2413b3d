#include "global_planner/node/global_planner_node.hpp"
#include "runtime/run.hpp"

int main(int argc, char** argv) {
  return coop::runtime::run<coop::global_planner::GlobalPlannerNode>(
      argc, argv, "global_planner", "Costmap and plans that the Ackermann base can drive");
}
