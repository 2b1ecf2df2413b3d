#include "referee/node/referee_node.hpp"
#include "runtime/run.hpp"

int main(int argc, char** argv) {
  return coop::runtime::run<coop::referee::RefereeNode>(
      argc, argv, "referee", "Judges every attempt of a simulated mission and writes it down");
}
