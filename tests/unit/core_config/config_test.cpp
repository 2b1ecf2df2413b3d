#include "core/config/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace coop::config {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Wheel {
  double radius = 0.1;
  void describe(Fields& fields) {
    fields.number("radius", radius, {.unit = "m", .help = "rolling radius", .min = 0.01, .max = 1});
  }
};

struct Robot {
  std::string name = "ducky";
  bool armed = false;
  int wheels_driven = 2;
  std::string mode = "paper";
  std::vector<double> weights{1.0, 2.0};
  Wheel spare;
  std::vector<Wheel> wheels;

  void describe(Fields& fields) {
    static constexpr std::array<std::string_view, 2> kModes{"paper", "best"};
    fields.text("name", name, {});
    fields.flag("armed", armed, {});
    fields.integer("wheels_driven", wheels_driven, {.min = 1, .max = 4});
    fields.choice("mode", mode, kModes, {});
    fields.numbers("weights", weights, {.min = 0});
    fields.section("spare", spare);
    fields.list("wheels", wheels);
  }
};

std::string error_of(std::string_view yaml, const std::string& set = "") {
  try {
    Document document = Document::parse(yaml, "robot.yaml");
    if (!set.empty()) document.set(set);
    (void)document.read<Robot>();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ConfigTest, AnEmptyDocumentLeavesTheDefaults) {
  const auto robot = Document::parse("", "robot.yaml").read<Robot>();
  EXPECT_EQ(robot.name, "ducky");
  EXPECT_THAT(robot.weights, ElementsAre(1.0, 2.0));
}

TEST(ConfigTest, EveryKindOfFieldIsRead) {
  const auto robot = Document::parse(R"(
name: goose
armed: true
wheels_driven: 4
mode: best
weights: [0.5, 3]
spare: {radius: 0.2}
wheels:
  - radius: 0.3
  - {}
)",
                                     "robot.yaml")
                         .read<Robot>();
  EXPECT_EQ(robot.name, "goose");
  EXPECT_TRUE(robot.armed);
  EXPECT_EQ(robot.wheels_driven, 4);
  EXPECT_EQ(robot.mode, "best");
  EXPECT_THAT(robot.weights, ElementsAre(0.5, 3.0));
  EXPECT_DOUBLE_EQ(robot.spare.radius, 0.2);
  ASSERT_EQ(robot.wheels.size(), 2U);
  EXPECT_DOUBLE_EQ(robot.wheels[0].radius, 0.3);
  EXPECT_DOUBLE_EQ(robot.wheels[1].radius, 0.1);
}

TEST(ConfigTest, AnUnknownKeySaysFileLineKeyAndTheNearestName) {
  EXPECT_EQ(error_of("name: a\nspare:\n  raduis: 0.2\n"),
            "robot.yaml:3: unknown key 'spare.raduis'; did you mean 'radius'?");
}

TEST(ConfigTest, AWrongTypeSaysWhatWasExpected) {
  EXPECT_EQ(error_of("wheels_driven: two"),
            "robot.yaml:1: wheels_driven: expected a whole number, got 'two'");
  EXPECT_THAT(error_of("armed: \"true\""), HasSubstr("expected true or false"));
  EXPECT_THAT(error_of("weights: 3"), HasSubstr("expected a list of numbers"));
  EXPECT_THAT(error_of("spare: 3"), HasSubstr("expected a mapping, got '3'"));
  EXPECT_THAT(error_of("mode: fast"), HasSubstr("expected one of paper, best, got 'fast'"));
}

TEST(ConfigTest, AValueOutOfBoundsSaysTheBoundsAndTheUnit) {
  EXPECT_EQ(error_of("spare: {radius: 7}"),
            "robot.yaml:1: spare.radius: expected a number from 0.01 to 1 (m), got '7'");
  EXPECT_THAT(error_of("weights: [1, -1]"), HasSubstr("of at least 0"));
}

TEST(ConfigTest, AnOverrideWinsAndIsNamedInItsErrors) {
  Document document = Document::parse("spare: {radius: 0.2}", "robot.yaml");
  document.set("spare.radius=0.4");
  document.set("name=swan");
  EXPECT_DOUBLE_EQ(document.read<Robot>().spare.radius, 0.4);
  EXPECT_EQ(document.read<Robot>().name, "swan");
  EXPECT_EQ(error_of("", "spare.radius=wide"),
            "--set: spare.radius: expected a number, got 'wide'");
  EXPECT_THAT(error_of("", "spare.width=1"), HasSubstr("--set: unknown key 'spare.width'"));
}

TEST(ConfigTest, BrokenYamlSaysTheLine) {
  EXPECT_THAT(error_of("name: a\nweights: [1, 2\n"), HasSubstr("robot.yaml:"));
  EXPECT_THAT(error_of("- a\n- b\n"), HasSubstr("expected a YAML mapping"));
}

TEST(ConfigTest, WhatIsWrittenReadsBackTheSame) {
  Robot robot;
  robot.name = "a \"quoted\" name";
  robot.wheels.resize(2);
  robot.wheels[1].radius = 0.7;
  const std::string yaml = to_yaml(robot);
  const auto back = Document::parse(yaml, "written").read<Robot>();
  EXPECT_EQ(back.name, robot.name);
  ASSERT_EQ(back.wheels.size(), 2U);
  EXPECT_DOUBLE_EQ(back.wheels[1].radius, 0.7);
  EXPECT_EQ(to_yaml(back), yaml);
}

struct Flock {
  std::vector<Named<Wheel>> carts;
  std::vector<Assignment> labels;
  void describe(Fields& fields) {
    fields.mapping("carts", carts);
    fields.assignments("labels", labels, {});
  }
};

TEST(ConfigTest, AMappingOfStructsKeepsOrderPlaceAndWhatALaterFileDoesNotSay) {
  Flock flock;
  Document::parse("carts:\n  red: {radius: 0.2}\n  blue:\n", "first.yaml").read(flock);
  Document::parse("carts:\n  green: {radius: 0.4}\n  red: {}\n", "second.yaml").read(flock);
  ASSERT_EQ(flock.carts.size(), 3U);
  EXPECT_EQ(flock.carts[0].name, "red");
  EXPECT_EQ(flock.carts[0].where, "second.yaml:3");
  EXPECT_DOUBLE_EQ(flock.carts[0].value.radius, 0.2);
  EXPECT_EQ(flock.carts[1].name, "blue");
  EXPECT_DOUBLE_EQ(flock.carts[1].value.radius, 0.1);
  EXPECT_EQ(flock.carts[2].name, "green");
  const std::string yaml = to_yaml(flock);
  const auto back = Document::parse(yaml, "written").read<Flock>();
  ASSERT_EQ(back.carts.size(), 3U);
  EXPECT_DOUBLE_EQ(back.carts[2].value.radius, 0.4);
}

TEST(ConfigTest, AnUnknownKeyInAMappingOfStructsIsFound) {
  try {
    (void)Document::parse("carts:\n  red:\n    raduis: 1\n", "a.yaml").read<Flock>();
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a.yaml:3: unknown key 'carts.red.raduis'; did you mean 'radius'?");
  }
}

TEST(ConfigTest, FreeKeysAreFlattenedWithTheirPlaceAndReadBackTheSame) {
  const auto flock = Document::parse(R"(labels:
  plain: 1.5
  deep: {text: "1.5", list: [1, "two", {x: 3}]}
)",
                                     "labels.yaml")
                         .read<Flock>();
  ASSERT_EQ(flock.labels.size(), 3U);
  EXPECT_EQ(flock.labels[0].key, "plain");
  EXPECT_EQ(flock.labels[0].value, "1.5");
  EXPECT_EQ(flock.labels[0].where, "labels.yaml:2");
  EXPECT_EQ(flock.labels[1].key, "deep.text");
  EXPECT_EQ(flock.labels[1].value, "\"1.5\"");
  EXPECT_EQ(flock.labels[1].text, "1.5");
  EXPECT_EQ(flock.labels[2].key, "deep.list");
  EXPECT_EQ(flock.labels[2].value, "[1, \"two\", {x: 3}]");
  EXPECT_EQ(flock.labels[2].where, "labels.yaml:3");
  EXPECT_EQ(Document::parse(to_yaml(flock), "written").read<Flock>().labels[2].value,
            flock.labels[2].value);
}

TEST(ConfigTest, AKeyThatStandsTwiceIsAnError) {
  EXPECT_EQ(error_of("name: a\narmed: true\nname: b\n"),
            "robot.yaml:3: key 'name' stands here twice");
}

TEST(ConfigTest, TheTableListsDefaultUnitAndBounds) {
  EXPECT_THAT(to_markdown_table<Robot>(),
              HasSubstr("| spare.radius | 0.1 | m | 0.01 .. 1 | rolling radius |"));
}

}  // namespace
}  // namespace coop::config
