#include "runtime/run.hpp"
#include "sequencer/node/sequencer_node.hpp"

int main(int argc, char** argv) {
  return coop::runtime::run<coop::sequencer::SequencerNode>(
      argc, argv, "sequencer", "Holds the mission: egg tracks, order, approach poses, journal");
}
