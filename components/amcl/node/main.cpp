#include "amcl/node/amcl_node.hpp"
#include "runtime/run.hpp"

int main(int argc, char** argv) {
  return coop::runtime::run<coop::amcl::AmclNode>(
      argc, argv, "amcl", "Localises on a known map, and serves it: adaptive Monte Carlo");
}
