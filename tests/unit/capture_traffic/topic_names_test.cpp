#include "capture/traffic/topic_names.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "capture/traffic/duration_text.hpp"

namespace coop::capture {
namespace {

TEST(TopicNames, FollowTheRuleOfRos2BothWays) {
  EXPECT_EQ(shown_topic("rt/camera/image"), "/camera/image");
  EXPECT_EQ(wire_topic("/camera/image"), "rt/camera/image");
  EXPECT_EQ(shown_topic("rr/serviceReply"), "rr/serviceReply");
  EXPECT_EQ(wire_topic("rr/serviceReply"), "rr/serviceReply");
}

TEST(TopicNames, TypesFollowItToo) {
  EXPECT_EQ(shown_type("sensor_msgs::msg::dds_::LaserScan_"), "sensor_msgs/msg/LaserScan");
  EXPECT_EQ(dds_type("sensor_msgs/msg/LaserScan"), "sensor_msgs::msg::dds_::LaserScan_");
  EXPECT_EQ(shown_type("HelloWorld"), "HelloWorld");
  EXPECT_EQ(dds_type("HelloWorld"), "HelloWorld");
}

TEST(TopicPatterns, AreGlobsOverTheWholeNameWithOrWithoutItsFirstSlash) {
  EXPECT_TRUE(matches("scan", "/scan"));
  EXPECT_TRUE(matches("/scan", "/scan"));
  EXPECT_FALSE(matches("scan", "/scan_2"));
  EXPECT_TRUE(matches("camera/*", "/camera/image"));
  EXPECT_TRUE(matches("*", "/camera/image"));
  EXPECT_TRUE(matches("*im*ge", "/camera/image"));
  EXPECT_TRUE(matches("?dom", "/odom"));
  EXPECT_FALSE(matches("?dom", "/dom"));
  EXPECT_FALSE(matches("camera", "/camera/image"));
}

TEST(TopicPatterns, BehindReAreRegularExpressions) {
  EXPECT_TRUE(matches("re:/(scan|odom)", "/odom"));
  EXPECT_TRUE(matches("re:(scan|odom)", "/odom"));
  EXPECT_FALSE(matches("re:/(scan|odom)", "/odometry"));
}

TEST(TopicSelection, TakesWhatIsAskedForAndNotExcluded) {
  const TopicSelection all{};
  EXPECT_TRUE(all.wants("/scan"));
  const TopicSelection some{.topics = {"camera/*", "scan"}, .exclude = {"*/depth"}};
  EXPECT_TRUE(some.wants("/camera/image"));
  EXPECT_FALSE(some.wants("/camera/depth"));
  EXPECT_FALSE(some.wants("/odom"));
}

TEST(TopicSelection, RefusesPatternsThatAreNone) {
  EXPECT_THROW((TopicSelection{.topics = {"re:("}, .exclude = {}}.validate()),
               std::invalid_argument);
  EXPECT_THROW((TopicSelection{.topics = {}, .exclude = {""}}.validate()), std::invalid_argument);
  EXPECT_NO_THROW((TopicSelection{.topics = {"("}, .exclude = {}}.validate()));
}

TEST(Durations, AreReadWithTheirUnits) {
  EXPECT_EQ(parse_duration("90"), 90.0);
  EXPECT_EQ(parse_duration("1.5s"), 1.5);
  EXPECT_EQ(parse_duration("250ms"), 0.25);
  EXPECT_EQ(parse_duration("10min"), 600.0);
  EXPECT_EQ(parse_duration("2h"), 7200.0);
  for (const char* wrong : {"", "min", "-3", "10 min", "3d", "nan", "inf"}) {
    EXPECT_FALSE(parse_duration(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace coop::capture
