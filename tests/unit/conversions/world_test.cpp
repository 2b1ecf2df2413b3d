#include "conversions/world.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace coop::conversions {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

world::GroundTruth truth() {
  return {.stamp = Time(std::chrono::seconds(9)),
          .robot_in_world = {1, 2, 0},
          .velocity = {0.5, -0.1},
          .steering_angle = 0.2,
          .in_collision = true,
          .collision_count = 3,
          .animal_collision_count = 2,
          .eggs = {{"egg1", {4, 5, 0.02}, world::EggState::kCollected}},
          .animals = {{"duck", {6, 7}, {0.1, -0.2}, 0.15}},
          .heaps = {{"heap1", {2, 3}, 0.07, world::HeapState::kCleaned}}};
}

world::World small_world() {
  world::World world;
  world.map_path = "house.yaml";
  world.grid = OccupancyGrid({2, 2, 0.05, {0, 0}}, kFree);
  world.eggs = {{"egg1", {4, 5, 0.02}, world::EggState::kOnFloor}};
  world.robot_start = {1, 1, 0};
  world.heaps = {{"heap1", {2, 3}, 0.07, world::HeapState::kOnFloor}};
  world.seed = 0xffff'ffff'ffff'fff1;
  return world;
}

TEST(WorldConversion, the_truth_survives_the_round_trip) {
  const auto message = to_msg(truth());
  EXPECT_EQ(message.header().frame_id(), "world");
  EXPECT_EQ(message.eggs()[0].state(), 2);
  EXPECT_EQ(message.animals()[0].velocity().y(), -0.2);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp, truth().stamp);
  EXPECT_EQ(back->robot_in_world, truth().robot_in_world);
  EXPECT_EQ(back->velocity, truth().velocity);
  EXPECT_EQ(back->steering_angle, 0.2);
  EXPECT_TRUE(back->in_collision);
  EXPECT_EQ(back->collision_count, 3U);
  EXPECT_EQ(back->animal_collision_count, 2U);
  EXPECT_EQ(back->eggs, truth().eggs);
  EXPECT_EQ(back->animals, truth().animals);
  EXPECT_EQ(back->heaps, truth().heaps);
}

TEST(WorldConversion, the_world_survives_the_round_trip) {
  const auto back = from_msg(to_msg(small_world(), Time(std::chrono::seconds(1))));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->map_path, "house.yaml");
  EXPECT_EQ(back->grid, small_world().grid);
  EXPECT_EQ(back->eggs, small_world().eggs);
  EXPECT_EQ(back->heaps, small_world().heaps);
  EXPECT_EQ(back->robot_start, small_world().robot_start);
  EXPECT_EQ(back->seed, small_world().seed);
}

TEST(WorldConversion, a_truth_that_cannot_be_is_refused) {
  const auto refused = [](const auto& damage) {
    auto message = to_msg(truth());
    damage(message);
    return !from_msg(message).has_value();
  };
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_TRUE(refused([](auto& m) { m.eggs()[0].state(4); }));
  EXPECT_TRUE(refused([](auto& m) { m.eggs()[0].position().z(kNan); }));
  EXPECT_TRUE(refused([](auto& m) { m.animals()[0].radius(-0.1); }));
  EXPECT_TRUE(refused([](auto& m) { m.animals()[0].velocity().x(kNan); }));
  EXPECT_TRUE(refused([](auto& m) { m.steering_angle(kNan); }));
  EXPECT_TRUE(refused([](auto& m) { m.robot().orientation().w(0.0); }));
  EXPECT_TRUE(refused([](auto& m) { m.velocity().linear().x(kNan); }));
}

TEST(WorldConversion, a_world_with_a_broken_grid_is_refused) {
  auto message = to_msg(small_world(), Time{});
  message.grid().data().pop_back();
  EXPECT_FALSE(from_msg(message));
}

}  // namespace
}  // namespace coop::conversions
