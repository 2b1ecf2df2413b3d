#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/traffic/frame_tree.hpp"
#include "capture/traffic/launch_files.hpp"
#include "capture/traffic/topic_statistics.hpp"
#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace coop::capture {
namespace {

using std::chrono::milliseconds;

Time second(double s) {
  return time_from_seconds(s);
}

TEST(TopicStatistics, TellRateSizeAndDelayOfTheWindow) {
  TopicStatistics statistics(5);
  EXPECT_FALSE(statistics.flow());
  for (int i = 0; i < 20; ++i) {
    statistics.add(second(0.1 * i), i < 10 ? 1 : 1000, milliseconds(i < 10 ? 900 : 3));
  }
  const auto flow = statistics.flow();
  ASSERT_TRUE(flow);
  EXPECT_NEAR(flow->rate, 10.0, 1e-6);
  EXPECT_NEAR(flow->bytes_per_second, 10'000.0, 1e-3);
  EXPECT_NEAR(flow->period.mean, 0.1, 1e-9);
  EXPECT_NEAR(flow->period.deviation, 0.0, 1e-9);
  EXPECT_NEAR(statistics.delay()->mean, 0.003, 1e-9);
  EXPECT_EQ(statistics.messages(), 20U);
}

TEST(TopicStatistics, HaveNoDelayWhereNoneIsTold) {
  TopicStatistics statistics(10);
  statistics.add(second(1), 8, std::nullopt);
  statistics.add(second(1), 8, std::nullopt);
  EXPECT_FALSE(statistics.delay());
  EXPECT_FALSE(statistics.flow()) << "no time has passed";
}

TEST(FrameTrees, AreDrawnFromTheirRootsWithWhoPublishes) {
  FrameTree tree;
  for (int i = 0; i < 11; ++i) tree.add("map", "odom", false, second(i), second(0.1 * i), "amcl");
  tree.add("odom", "base_link", false, second(1), second(1), "simulator");
  tree.add("base_link", "laser_link", true, second(0), second(0), "lidar_driver");
  EXPECT_EQ(tree.text(second(1.5)),
            "map\n"
            "  odom  (10.0 Hz, 0.50 s old, by amcl)\n"
            "    base_link  (0.0 Hz, 0.50 s old, by simulator)\n"
            "      laser_link  (static, by lidar_driver)\n");
  EXPECT_THAT(tree.complaints(), ::testing::IsEmpty());
}

TEST(FrameTrees, SayWhatIsWrongWithThem) {
  FrameTree tree;
  tree.add("map", "odom", false, second(1), second(1), "amcl");
  tree.add("map", "odom", false, second(1), second(1), "slam");
  tree.add("world", "camera", true, second(1), second(1), "camera_driver");
  tree.add("a", "b", false, second(1), second(1), "x");
  tree.add("b", "a", false, second(1), second(1), "x");
  tree.add("map", "camera", true, second(1), second(1), "camera_driver");
  EXPECT_THAT(tree.complaints(),
              ::testing::UnorderedElementsAre("odom has several publishers: amcl, slam",
                                              "camera has several parents: map, world",
                                              "a is above itself", "b is above itself"));
}

TEST(FilesOfALaunch, AreItsConfigurationsAndAllOfWhichTheySpeak) {
  const test::TemporaryFolder share;
  const auto write = [&](const char* name, const char* text) {
    write_file_atomically(share.path() / name, text);
  };
  write("config/dwa.yaml", "robot: config/robot/r.urdf\n");
  write("config/idle.yaml", "");
  write("config/chassis.yaml", "");
  write("config/robot/r.urdf", "<robot/>");
  write("maps/house.yaml", "image: house.pgm\n");
  write("maps/house.pgm", "P5");
  const auto files = files_of_launch(
      "variables:\n  map: maps/house.yaml\ncomponents:\n  dwa:\n    enabled: true\n  base:\n    "
      "executable: \"chassis\"\n  missing:\n    config: config/none.yaml\n",
      share.path());
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.filename().string());
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("dwa.yaml", "r.urdf", "chassis.yaml",
                                                     "house.yaml", "house.pgm"));
}

}  // namespace
}  // namespace coop::capture
