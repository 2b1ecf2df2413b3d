#include "runtime/world_feed.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/simulated_world.hpp"

namespace coop::runtime {
namespace {

using namespace std::chrono_literals;

/// A driver that measures nothing: it counts.
struct Driver {
  struct Config {};
  Driver(Node& node, const Config&)
      : feed(node, 5.0,
             {.world = [this](const world::World&) { ++worlds; },
              .measure =
                  [this](const world::GroundTruth& truth) { moments.push_back(truth.stamp); }}) {}

  int worlds = 0;
  std::vector<Time> moments;
  WorldFeed feed;
};

class WorldFeedTest : public testing::Test {
 protected:
  [[nodiscard]] Health health() { return fixture_.node_of("driver").health(); }

  test::ComponentFixture fixture_;
  test::SimulatedWorld simulator_{fixture_};
  Driver& driver_ = fixture_.add<Driver>("driver", {});
};

TEST_F(WorldFeedTest, MeasuresAtTheMultiplesOfThePeriod) {
  simulator_.publish_world();
  simulator_.publish_truth(1s);
  ASSERT_EQ(driver_.moments.size(), 5U);
  for (const Time moment : driver_.moments) EXPECT_EQ(to_nanoseconds(moment) % 200'000'000, 0);
}

TEST_F(WorldFeedTest, OneThatStartedLateMeasuresAtTheSameMoments) {
  simulator_.publish_world();
  simulator_.publish_truth(300ms);
  driver_.moments.clear();
  const Driver& late = fixture_.add<Driver>("late", {});
  EXPECT_EQ(late.worlds, 1) << "the world is latched";
  simulator_.publish_truth(400ms);
  EXPECT_EQ(late.moments.size(), 2U);
  EXPECT_EQ(late.moments, driver_.moments);
}

TEST_F(WorldFeedTest, IsDegradedWithoutWorldOrGroundTruthAndRecovers) {
  fixture_.advance(1s);
  EXPECT_EQ(health(), Health::kDegraded);
  simulator_.publish_truth(200ms);
  EXPECT_EQ(health(), Health::kDegraded);
  EXPECT_TRUE(driver_.moments.empty());
  simulator_.publish_world();
  simulator_.publish_truth(200ms);
  EXPECT_EQ(health(), Health::kReady);
  fixture_.advance(1s);
  EXPECT_EQ(health(), Health::kDegraded);
  simulator_.publish_truth(200ms);
  EXPECT_EQ(health(), Health::kReady);
}

TEST_F(WorldFeedTest, AWorldAndAGroundTruthThatAreNoneChangeNothing) {
  simulator_.publish_world();
  simulator_.publish_world(coop_msgs::msg::World());
  EXPECT_EQ(driver_.worlds, 1);
  simulator_.scene.eggs.push_back(
      {"egg_1", {1, 1, std::numeric_limits<double>::quiet_NaN()}, world::EggState::kOnFloor});
  simulator_.publish_truth(400ms);
  EXPECT_TRUE(driver_.moments.empty());
  simulator_.scene.eggs.clear();
  simulator_.publish_truth(400ms);
  EXPECT_EQ(driver_.moments.size(), 2U);
}

}  // namespace
}  // namespace coop::runtime
