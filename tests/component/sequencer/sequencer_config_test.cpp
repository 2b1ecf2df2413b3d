#include <gtest/gtest.h>

#include "core/config/error.hpp"
#include "sequencer/node/sequencer_node.hpp"

namespace coop::sequencer {
namespace {

TEST(SequencerConfigTest, AMissionThatBeginsByItselfMustBeOneForTheRobot) {
  const std::string robots = std::string(COOP_SOURCE_DIR) + "/config/robot/";
  SequencerConfig config;
  config.robot = robots + "egg_collector.urdf";
  config.autostart = "collect";
  EXPECT_NO_THROW(SequencerNode::check(config));
  config.autostart = "clean";
  EXPECT_THROW(SequencerNode::check(config), config::Error);
  config.robot = robots + "pen_cleaner.urdf";
  EXPECT_NO_THROW(SequencerNode::check(config));
  config.autostart = "collect";
  EXPECT_THROW(SequencerNode::check(config), config::Error);
}

TEST(SequencerConfigTest, ARobotIsRequired) {
  SequencerConfig config;
  config.robot = "no/such/robot.urdf";
  EXPECT_ANY_THROW(SequencerNode::check(config));
}

}  // namespace
}  // namespace coop::sequencer
