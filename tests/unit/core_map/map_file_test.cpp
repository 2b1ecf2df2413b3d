#include "core/map/map_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <system_error>

#include "core/atomic_file.hpp"
#include "core/config/error.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace coop::map {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

MapMetadata metadata(const std::string& mode, double free_thresh = 0.25,
                     double occupied_thresh = 0.65) {
  MapMetadata result;
  result.image = "x.pgm";
  result.mode = mode;
  result.free_thresh = free_thresh;
  result.occupied_thresh = occupied_thresh;
  return result;
}

TEST(MapImage, TopRowOfTheImageIsTheHighestRowOfTheGrid) {
  const GreyImage image{2, 2, 255, {0, 254, 254, 254}};
  const auto grid = to_grid(image, metadata("trinary"));
  EXPECT_EQ((grid[{0, 1}]), kOccupied);
  EXPECT_EQ((grid[{0, 0}]), kFree);
}

TEST(MapImage, TrinaryHasThreeValuesByTheThresholds) {
  // Darkness 1, 0.66, 0.65, 0.3, 0.25, 0.24, 0.
  const GreyImage image{7, 1, 100, {0, 34, 35, 70, 75, 76, 100}};
  EXPECT_THAT(to_grid(image, metadata("trinary")).cells, ElementsAre(100, 100, -1, -1, -1, 0, 0));
}

TEST(MapImage, NegateTurnsBlackAndWhite) {
  MapMetadata negated = metadata("trinary");
  negated.negate = 1;
  const GreyImage image{3, 1, 255, {0, 128, 255}};
  EXPECT_THAT(to_grid(image, negated).cells, ElementsAre(0, -1, 100));
}

TEST(MapImage, ScaleIsLinearBetweenTheThresholds) {
  // Darkness 0.1, 0.3, 0.5, 0.7, 0.9 between the thresholds 0.2 and 0.8.
  const GreyImage image{5, 1, 10, {9, 7, 5, 3, 1}};
  EXPECT_THAT(to_grid(image, metadata("scale", 0.2, 0.8)).cells, ElementsAre(0, 17, 50, 83, 100));
}

TEST(MapImage, RawTakesPixelsAsPercent) {
  const GreyImage image{4, 1, 255, {0, 55, 100, 101}};
  EXPECT_THAT(to_grid(image, metadata("raw")).cells, ElementsAre(0, 55, 100, -1));
}

class MapFile : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& content) {
    write_file_atomically(path(name), content);
  }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return folder_.path() / name;
  }

  test::TemporaryFolder folder_;
};

TEST_F(MapFile, WhatIsSavedIsLoadedAgain) {
  OccupancyGrid grid({3, 2, 0.05, {-1.25, 2.5}}, kUnknown);
  grid[{0, 0}] = kOccupied;
  grid[{2, 1}] = kFree;
  save_map(grid, path("barn"));
  EXPECT_EQ(load_map(path("barn.yaml")), grid);
}

TEST_F(MapFile, IsWrittenUnderItsStemWhicheverFileIsNamed) {
  const OccupancyGrid grid({1, 1, 0.1, {0, 0}}, kFree);
  for (const char* name : {"a", "b.yaml", "c.pgm", "sub/folder/d"}) save_map(grid, path(name));
  for (const char* name : {"a.pgm", "b.yaml", "c.yaml", "sub/folder/d.pgm"})
    EXPECT_TRUE(std::filesystem::exists(path(name))) << name;
}

TEST_F(MapFile, NamesThatNeedQuotesInYamlSurvive) {
  const OccupancyGrid grid({1, 1, 0.1, {0, 0}}, kFree);
  save_map(grid, path("no: map #1"));
  EXPECT_EQ(load_map(path("no: map #1.yaml")), grid);
}

TEST_F(MapFile, FolderThatCannotBeWrittenIsASystemErrorAndLeavesNothing) {
  write("file", "");
  EXPECT_THROW(save_map(OccupancyGrid({1, 1, 0.1, {0, 0}}, kFree), path("file/map")),
               std::system_error);
}

TEST_F(MapFile, UnknownKeyIsAnErrorThatNamesTheNearest) {
  write("m.yaml", "image: m.pgm\nresolutoin: 0.05\n");
  EXPECT_THAT(
      [&] { (void)load_map(path("m.yaml")); },
      ThrowsMessage<config::Error>(testing::AllOf(HasSubstr("m.yaml"), HasSubstr("resolution"))));
}

TEST_F(MapFile, ValuesThatMakeNoMapAreRefusedWithTheFile) {
  write("x.pgm", "P2 1 1 1 1\n");
  for (const char* yaml :
       {"resolution: 0.1\n", "image: x.pgm\nresolution: 0\n", "image: x.pgm\norigin: [1, 2]\n",
        "image: x.pgm\norigin: [0, 0, 0.5]\n", "image: x.pgm\nmode: colour\n",
        "image: x.pgm\nfree_thresh: 0.7\noccupied_thresh: 0.6\n", "image: x.pgm\nnegate: 2\n"}) {
    write("m.yaml", yaml);
    EXPECT_THAT([&] { (void)load_map(path("m.yaml")); },
                ThrowsMessage<config::Error>(HasSubstr("m.yaml")))
        << yaml;
  }
}

TEST_F(MapFile, MissingFilesAreSystemErrorsThatNameThem) {
  write("m.yaml", "image: gone.pgm\n");
  EXPECT_THAT([&] { (void)load_map(path("m.yaml")); },
              ThrowsMessage<std::system_error>(HasSubstr("gone.pgm")));
  EXPECT_ANY_THROW((void)load_map(path("nowhere.yaml")));
}

TEST_F(MapFile, ImageThatIsNoPgmIsAMapError) {
  write("m.yaml", "image: m.png\n");
  write("m.png", "\x89PNG");
  EXPECT_THAT([&] { (void)load_map(path("m.yaml")); }, ThrowsMessage<MapError>(HasSubstr("m.png")));
}

TEST_F(MapFile, AbsoluteImagePathIsTakenAsItIs) {
  write("elsewhere/m.pgm", "P2 1 1 1 0\n");
  write("m.yaml", "image: " + path("elsewhere/m.pgm").string() + "\n");
  EXPECT_THAT(load_map(path("m.yaml")).cells, ElementsAre(kOccupied));
}

TEST(RealMaps, OfOtherMakersAreRead) {
  struct Expectation {
    const char* name;
    int width;
    int height;
    double resolution;
  };
  for (const auto& [name, width, height, resolution] :
       {Expectation{"maps/house/map.yaml", 500, 500, 0.05},
        {"maps/turtlebot3_world/map.yaml", 384, 384, 0.05},
        {"maps/warehouse/warehouse.yaml", 1006, 1674, 0.03},
        {"maps/map_server_cases/TenByTen.yaml", 10, 10, 1.0},
        {"maps/willow_garage/cave.yaml", 500, 500, 0.02}}) {
    const auto path = test::shared_data(name);
    if (!path) GTEST_SKIP() << "not run: the shared data set is absent";
    const auto grid = load_map(*path);
    EXPECT_EQ(grid.geometry.width, width) << name;
    EXPECT_EQ(grid.geometry.height, height) << name;
    EXPECT_DOUBLE_EQ(grid.geometry.resolution, resolution) << name;
    EXPECT_GT(std::ranges::count(grid.cells, kFree), 0) << name;
    EXPECT_GT(std::ranges::count(grid.cells, kOccupied), 0) << name;
  }
}

}  // namespace
}  // namespace coop::map
