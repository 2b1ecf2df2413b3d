#include "referee/cleaning.hpp"

#include <gtest/gtest.h>

namespace coop::referee {
namespace {

/// A robot with a blade from 0.3 to 0.4 m ahead, 0.4 m wide, that drives along x.
class CleaningTest : public ::testing::Test {
 protected:
  CleaningTest() {
    world::World world;
    world.heaps = {{"ahead", {2.0, 0.05}, 0.1, world::HeapState::kOnFloor},
                   {"beside", {3.0, 0.15}, 0.1, world::HeapState::kOnFloor}};
    cleaning_.begin(world);
    cleaning_.begin_mission(time_from_seconds(10.0));
    see(10.0, 0.0);
  }
  void see(double seconds, double x, std::uint32_t animals = 0, std::uint32_t collisions = 0) {
    world::GroundTruth truth;
    truth.stamp = time_from_seconds(seconds);
    truth.robot_in_world = {x, 0.0, 0.0};
    truth.animal_collision_count = animals;
    truth.collision_count = collisions;
    cleaning_.see(truth);
  }
  Cleaning cleaning_{Eigen::AlignedBox2d(Eigen::Vector2d(0.3, -0.2), Eigen::Vector2d(0.4, 0.2))};
};

TEST_F(CleaningTest, AHeapIsCoveredWhenTheBladePassesOverItAsAWhole) {
  for (int step = 1; step <= 40; ++step) see(10.0 + step, 0.1 * step);
  const auto heaps = cleaning_.heaps();
  ASSERT_EQ(heaps.size(), 2U);
  EXPECT_EQ(heaps[0].heap.id, "ahead");
  EXPECT_TRUE(heaps[0].covered);
  EXPECT_NEAR(heaps[0].time, 16.0, 1.01);
  EXPECT_NEAR(heaps[0].path_length, 1.6, 0.11);
  EXPECT_FALSE(heaps[1].covered);  // the blade's end grazes it
  EXPECT_EQ(heaps[1].time, 40.0);
  EXPECT_NEAR(heaps[0].path_length + heaps[1].path_length, 4.0, 1e-9);
}

TEST_F(CleaningTest, NoHeapIsMissedBetweenTwoSamples) {
  see(11.0, 1.0);
  see(12.0, 3.0);
  EXPECT_TRUE(cleaning_.heaps()[0].covered);
}

TEST_F(CleaningTest, BackwardsNothingIsCleaned) {
  world::World world;
  world.heaps = {{"behind", {0.2, 0.0}, 0.1, world::HeapState::kOnFloor}};
  Cleaning cleaning(Eigen::AlignedBox2d(Eigen::Vector2d(0.3, -0.2), Eigen::Vector2d(0.4, 0.2)));
  cleaning.begin(world);
  for (int step = 0; step <= 10; ++step) {
    world::GroundTruth truth;
    truth.robot_in_world = {-0.05 * step, 0.0, 0.0};
    cleaning.see(truth);
  }
  EXPECT_FALSE(cleaning.heaps()[0].covered);
}

TEST_F(CleaningTest, CollisionsCountForTheHeapThatComesNext) {
  see(11.0, 1.0, 1, 1);
  see(12.0, 1.65, 1, 1);
  see(13.0, 1.7, 1, 1);
  see(14.0, 1.9, 2, 3);
  const auto heaps = cleaning_.heaps();
  EXPECT_EQ(heaps[0].animals, 1U);
  EXPECT_EQ(heaps[0].others, 0U);
  EXPECT_EQ(heaps[1].animals, 1U);
  EXPECT_EQ(heaps[1].others, 1U);
}

TEST_F(CleaningTest, RowsFitTheirColumns) {
  const auto row = to_row(cleaning_.heaps()[0], 7, 1, 12.5);
  const auto columns = heap_columns();
  ASSERT_EQ(row.size(), columns.size());
  EXPECT_EQ(row[0], "7");
  EXPECT_EQ(row[2], "ahead");
  EXPECT_EQ(row[6], "0");
  EXPECT_EQ(row[9], "12.50");
}

}  // namespace
}  // namespace coop::referee
