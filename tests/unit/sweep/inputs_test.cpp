#include "sweep/inputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace coop::sweep {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::Not;

/// A small Coop: a launch file that includes another one, programs, a map with its image.
class InputsTest : public ::testing::Test {
 protected:
  InputsTest() {
    places_ = {folder_.path() / "bin", folder_.path()};
    write("config/launch/trial.yaml", "include: [base.yaml]  # not config/amcl.yaml\n");
    write("config/launch/base.yaml",
          "variables: {map: maps/barn.yaml}\n"
          "components:\n  dwa: {parameters: {speed: 1}}\n  eye: {executable: camera}\n");
    write("config/dwa.yaml", "speed: 2\n");
    write("config/amcl.yaml", "{}\n");
    write("config/robot/robot.urdf", "<robot/>\n");
    write("maps/barn.yaml", "image: barn.pgm\n");
    write("maps/barn.pgm", "P5");
    write("maps/other.yaml", "image: barn.pgm\n");
    for (const char* name : {"launcher", "dwa", "camera", "amcl"}) program(name, "1");
    config_.launch = "config/launch/trial.yaml";
    config_.seeds = 2;
  }
  void write(const std::string& name, const std::string& content) {
    write_file_atomically(folder_.path() / name, content);
  }
  void program(const std::string& name, const std::string& content) {
    write("bin/" + name, content);
    std::filesystem::permissions(places_.programs / name, std::filesystem::perms::owner_all);
  }
  [[nodiscard]] Inputs inputs() const { return find_inputs(config_, places_); }
  /// What differs after `change` from before.
  template <class Change>
  [[nodiscard]] std::vector<std::string> changed_by(Change change) {
    const Inputs before = inputs();
    change();
    return differences(before, inputs());
  }

  test::TemporaryFolder folder_;
  Places places_;
  SweepConfig config_;
};

TEST_F(InputsTest, WhatTheLaunchFileNamesIsFollowedToTheEnd) {
  const Inputs found = inputs();
  for (const char* name : {"config/launch/trial.yaml", "config/launch/base.yaml", "config/dwa.yaml",
                           "maps/barn.yaml", "maps/barn.pgm", "config/robot/robot.urdf",
                           "program launcher", "program dwa", "program camera", "sweep: grid"}) {
    EXPECT_THAT(found, Contains(Key(name)));
  }
  EXPECT_THAT(found, Not(Contains(Key("program amcl")))) << "not part of this system";
  EXPECT_THAT(found, Not(Contains(Key("maps/other.yaml"))));
  EXPECT_THAT(found, Not(Contains(Key("config/amcl.yaml")))) << "a comment";
}

TEST_F(InputsTest, ALaunchFileIsFoundByItsNameAloneToo) {
  config_.launch = "trial";
  EXPECT_THAT(inputs(), Contains(Key("maps/barn.pgm")));
}

TEST_F(InputsTest, AChangedFileOrProgramIsNamed) {
  EXPECT_THAT(changed_by([] {}), IsEmpty());
  EXPECT_THAT(changed_by([&] { write("config/dwa.yaml", "speed: 3\n"); }),
              ElementsAre("config/dwa.yaml"));
  EXPECT_THAT(changed_by([&] { program("camera", "2"); }), ElementsAre("program camera"));
  EXPECT_THAT(changed_by([&] { program("amcl", "2"); }), IsEmpty());
}

TEST_F(InputsTest, AFileThatASettingNamesIsAnInput) {
  EXPECT_THAT(changed_by([&] { config_.settings = {"map=maps/other.yaml"}; }),
              ElementsAre("maps/other.yaml", "sweep: settings"));
  EXPECT_THAT(changed_by([&] { write("maps/other.yaml", "image: barn.pgm \n"); }),
              ElementsAre("maps/other.yaml"));
}

TEST_F(InputsTest, ASweepOfOnePointMayGetMoreSeedsAndAnyMayGetOtherFigures) {
  EXPECT_THAT(changed_by([&] { config_.seeds = 3; }), IsEmpty());
  EXPECT_THAT(changed_by([&] { config_.figures = {{"hit", "", "hit", "share", ""}}; }), IsEmpty());
  EXPECT_THAT(changed_by([&] { config_.first_seed = 9; }), ElementsAre("sweep: seeds"));
  config_.grid = {{"dwa.speed", "", {"1", "2"}}};
  EXPECT_THAT(changed_by([&] { config_.seeds = 4; }), ElementsAre("sweep: seeds"))
      << "the runs of the second point would get other numbers";
}

TEST_F(InputsTest, TheyComeBackFromTheirFile) {
  const Inputs found = inputs();
  EXPECT_EQ(inputs_from_text(to_text(found)), found);
  EXPECT_THROW((void)inputs_from_text("abc\n"), std::runtime_error);
  EXPECT_THROW((void)inputs_from_text("12  cut off"), std::runtime_error);
}

TEST_F(InputsTest, ALongListOfChangesIsCutShort) {
  EXPECT_EQ(shown_differences({{"a", "1"}}, {{"a", "1"}}), "");
  EXPECT_EQ(shown_differences({{"a", "1"}, {"b", "1"}}, {{"a", "2"}, {"c", "1"}}), "a, b, c");
  EXPECT_EQ(
      shown_differences({}, {{"a", ""}, {"b", ""}, {"c", ""}, {"d", ""}, {"e", ""}, {"f", ""}}),
      "a, b, c, d and 2 more");
}

}  // namespace
}  // namespace coop::sweep
