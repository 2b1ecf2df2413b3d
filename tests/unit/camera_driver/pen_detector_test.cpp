// Pigs and manure in simulated pictures from under the ceiling: what is found, and where.
#include "camera_driver/pen_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "camera_driver/overhead_camera.hpp"
#include "core/random.hpp"
#include "support/room.hpp"

namespace coop::camera_driver {
namespace {

using Eigen::Vector2d;

class OverheadPen : public testing::Test {
 protected:
  PenSighting look(std::uint64_t seed = 1) {
    OverheadCamera camera(mount_, {}, pen_,
                          {{{-0.12, -0.21}, {0.44, -0.21}, {0.44, 0.21}, {-0.12, 0.21}}}, seed);
    Frame frame;
    scene_.stamp = time_from_seconds(1.0);
    camera.take(scene_, frame);
    return PenDetector({}, mount_).detect(frame.colour);
  }
  void add_heap(const Vector2d& place, double radius = 0.07) {
    scene_.heaps.push_back(
        {"heap_" + std::to_string(scene_.heaps.size()), place, radius, world::HeapState::kOnFloor});
  }
  void add_pig(const Vector2d& place) { scene_.animals.push_back({"pig", place, {0, 0}, 0.25}); }
  /// Distance of the nearest one, m.
  static double nearest(const std::vector<Detection>& found, const Vector2d& place) {
    double best = 1e9;
    for (const Detection& one : found) {
      best = std::min(best, (one.position.head<2>() - place).norm());
    }
    return best;
  }

  OverheadMount mount_;
  world::World pen_ = coop::test::room(50, 30);
  world::GroundTruth scene_;
};

TEST_F(OverheadPen, AnEmptyPenWithWaterFeedAndRobotShowsNeitherPigsNorManure) {
  scene_.robot_in_world = {2.0, 1.0, 0.7};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PenSighting seen = look(seed);
    EXPECT_TRUE(seen.pigs.empty()) << seed;
    EXPECT_TRUE(seen.heaps.empty()) << seed;
  }
}

TEST_F(OverheadPen, HeapsAreFoundWhereTheyLieInTheMapAndAsLargeAsTheyAre) {
  scene_.robot_in_world = {2.5, 1.5, 0.0};
  const std::vector<Vector2d> places{{0.3, 0.3}, {4.7, 0.35}, {1.5, 2.6}, {4.2, 2.7}, {3.4, 0.9}};
  for (const Vector2d& place : places) add_heap(place);
  const PenSighting seen = look();
  ASSERT_EQ(seen.heaps.size(), places.size());
  for (const Vector2d& place : places) EXPECT_LT(nearest(seen.heaps, place), 0.02);
  for (const Detection& heap : seen.heaps) {
    EXPECT_EQ(heap.class_id, "manure");
    EXPECT_NEAR(heap.size.x(), 0.14, 0.03);
  }
}

TEST_F(OverheadPen, PigsAreFoundBelowTheirBacks) {
  scene_.robot_in_world = {0.5, 0.5, 0.0};
  const std::vector<Vector2d> places{{1.0, 2.5}, {4.6, 0.4}, {2.6, 1.4}};
  for (const Vector2d& place : places) add_pig(place);
  const PenSighting seen = look();
  ASSERT_EQ(seen.pigs.size(), places.size());
  for (const Vector2d& place : places) EXPECT_LT(nearest(seen.pigs, place), 0.06);
}

TEST_F(OverheadPen, PigsThatStandSideBySideAreToldApart) {
  add_pig({2.0, 1.5});
  add_pig({2.52, 1.5});
  scene_.robot_in_world = {0.5, 0.5, 0.0};
  EXPECT_EQ(look().pigs.size(), 2U);
}

TEST_F(OverheadPen, AHeapUnderAPigOrTheRobotIsNotSeenAndACleanedOneIsGone) {
  add_heap({1.0, 1.0});
  add_heap({3.0, 2.0});
  add_heap({4.0, 1.0});
  scene_.heaps[2].state = world::HeapState::kCleaned;
  scene_.robot_in_world = {0.85, 1.0, 0.0};
  add_pig({3.0, 2.0});
  EXPECT_TRUE(look().heaps.empty());
}

TEST_F(OverheadPen, AHeapBesideAPigIsLessSure) {
  add_heap({3.0, 2.0});
  add_pig({3.0, 1.66});
  scene_.robot_in_world = {0.5, 0.5, 0.0};
  const PenSighting seen = look();
  ASSERT_EQ(seen.heaps.size(), 1U);
  EXPECT_EQ(seen.heaps[0].score, 0.5);
  EXPECT_GT(seen.heaps[0].covariance(0, 0), 0.05 * 0.05);
}

/// Random pens: five heaps and three pigs, none hidden.
TEST_F(OverheadPen, InRandomPensAllIsFoundAndNothingElse) {
  RandomStream random(7, "pens");
  int heaps = 0;
  for (int pen = 0; pen < 40; ++pen) {
    scene_ = {};
    std::vector<Vector2d> taken;
    const auto draw = [&](double wall, double apart) {
      for (;;) {
        const Vector2d place(random.uniform(wall, 5.0 - wall), random.uniform(wall, 3.0 - wall));
        const bool free = std::ranges::all_of(
            taken, [&](const Vector2d& other) { return (other - place).norm() > apart; });
        if (!free) continue;
        taken.push_back(place);
        return place;
      }
    };
    const Vector2d robot = draw(0.5, 0.0);
    scene_.robot_in_world = {robot.x(), robot.y(), random.uniform(-3.0, 3.0)};
    for (int i = 0; i < 3; ++i) add_pig(draw(0.3, 0.9));
    for (int i = 0; i < 5; ++i) add_heap(draw(0.2, 0.6), random.uniform(0.05, 0.09));
    const PenSighting seen = look(static_cast<std::uint64_t>(pen));
    EXPECT_EQ(seen.pigs.size(), 3U) << pen;
    EXPECT_EQ(seen.heaps.size(), 5U) << pen;
    for (const world::Heap& heap : scene_.heaps) {
      heaps += nearest(seen.heaps, heap.position) < 0.03 ? 1 : 0;
    }
    for (const Detection& pig : seen.pigs) EXPECT_NEAR(pig.size.x(), 0.5, 0.06) << pen;
    for (const world::Animal& pig : scene_.animals) {
      EXPECT_LT(nearest(seen.pigs, pig.position), 0.08) << pen;
    }
  }
  EXPECT_EQ(heaps, 200);
}

TEST(OverheadMount, APointOfTheFloorComesBackFromThePictureToWhereItWas) {
  OverheadMount mount;
  mount.yaw = 0.4;
  mount.x = -1.0;
  const Pose3 camera = mount.camera_in_map();
  EXPECT_NEAR(camera.linear().determinant(), 1.0, 1e-12);
  const Eigen::Vector3d place(0.3, 2.1, 0.0);
  const Vector2d pixel = mount.intrinsics().project(camera.inverse() * place);
  const Eigen::Vector3d back =
      camera * (mount.height * mount.intrinsics().ray(pixel.x(), pixel.y()));
  EXPECT_TRUE(back.isApprox(place, 1e-9));
}

}  // namespace
}  // namespace coop::camera_driver
