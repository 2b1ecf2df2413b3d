#include "launcher/launch_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace coop::launcher {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

class LaunchFileTest : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    write_file_atomically(folder_.path() / name, text);
    return folder_.path() / name;
  }
  std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
      (void)load_launch(write("bad.yaml", text), overrides);
    } catch (const config::Error& error) {
      return error.what();
    }
    return "no error";
  }
  test::TemporaryFolder folder_;
};

TEST_F(LaunchFileTest, ComponentsKeepTheirOrderAndWhatIsNotSaidHasDefaults) {
  const Launch launch = load_launch(write("a.yaml", R"(
robot: ducky
domain: 7
components:
  simulator:
  amcl:
    after: [simulator]
    parameters: {particles: {min: 100, max: 2000}}
    restart: {policy: always, give_up_after: 3}
)"),
                                    {});
  EXPECT_EQ(launch.robot, "ducky");
  EXPECT_EQ(launch.domain, 7);
  ASSERT_EQ(launch.components.size(), 2U);
  EXPECT_EQ(launch.components[0].name, "simulator");
  EXPECT_EQ(launch.components[0].value.restart.policy, "on-failure");
  const Component& amcl = launch.components[1].value;
  EXPECT_THAT(amcl.after, ElementsAre("simulator"));
  EXPECT_EQ(amcl.restart.policy, "always");
  EXPECT_EQ(amcl.restart.give_up_after, 3);
  ASSERT_EQ(amcl.parameters.size(), 2U);
  EXPECT_EQ(amcl.parameters[1].key, "particles.max");
  EXPECT_EQ(amcl.parameters[1].value, "2000");
}

TEST_F(LaunchFileTest, AnIncludingFileAddsToAndOverridesWhatItIncludes) {
  write("base.yaml", "seed: 5\ncomponents:\n  dwa: {parameters: {v: 1, w: 2}}\n  amcl: {}\n");
  const Launch launch = load_launch(
      write("top.yaml",
            "include: [base.yaml]\ncomponents:\n  slam: {}\n  dwa: {parameters: {v: 3}}\n  amcl: "
            "{enabled: false}\n"),
      {});
  EXPECT_EQ(launch.seed, 5);
  ASSERT_EQ(launch.components.size(), 3U);
  EXPECT_EQ(launch.components[0].name, "dwa");
  EXPECT_EQ(launch.components[0].value.parameters[0].value, "3");
  EXPECT_EQ(launch.components[0].value.parameters[1].value, "2");
  EXPECT_FALSE(launch.components[1].value.enabled);
  EXPECT_EQ(launch.components[2].name, "slam");
}

TEST_F(LaunchFileTest, ComponentsStartFromTheDefaultsOfTheirFile) {
  const Launch launch = load_launch(
      write("a.yaml",
            "defaults: {restart: {policy: always}, environment: {A: 1}}\ncomponents:\n  a:\n  b: "
            "{restart: {policy: never}, environment: {B: 2}}\n"),
      {});
  EXPECT_EQ(launch.components[0].value.restart.policy, "always");
  EXPECT_EQ(launch.components[1].value.restart.policy, "never");
  EXPECT_EQ(launch.components[1].value.environment.size(), 2U);
}

TEST_F(LaunchFileTest, AnErrorInAnIncludedFileNamesThatFile) {
  write("base.yaml", "components:\n  dwa:\n    paramters: {v: 1}\n");
  EXPECT_THAT(error_of("include: [base.yaml]\n"),
              EndsWith("base.yaml:3: unknown key 'components.dwa.paramters'; did you mean "
                       "'parameters'?"));
  EXPECT_THAT(error_of("include: [absent.yaml]\n"), HasSubstr("absent.yaml: no such"));
}

TEST_F(LaunchFileTest, AFileThatIncludesItselfIsRefused) {
  write("other.yaml", "include: [bad.yaml]\n");
  EXPECT_THAT(error_of("include: [other.yaml]\n"), HasSubstr("includes itself"));
}

TEST_F(LaunchFileTest, OverridesNameAComponentsParameterAVariableOrALaunchKey) {
  const auto file = write("a.yaml",
                          "seed: 1\nvariables: {map: a.yaml}\ncomponents:\n  dwa: {parameters: "
                          "{max_vel_x: 0.6}}\n  amcl:\n");
  const Launch launch = load_launch(file, {"dwa.max_vel_x=0.4", "dwa.limits.w=2", "map=b.yaml",
                                           "seed=9", "components.amcl.required=false"});
  const auto& parameters = launch.components[0].value.parameters;
  ASSERT_EQ(parameters.size(), 2U);
  EXPECT_EQ(parameters[0].value, "0.4");
  EXPECT_EQ(parameters[0].where, "--set");
  EXPECT_EQ(parameters[1].key, "limits.w");
  EXPECT_EQ(launch.variables[0].value, "b.yaml");
  EXPECT_EQ(launch.seed, 9);
  EXPECT_FALSE(launch.components[1].value.required);
}

TEST_F(LaunchFileTest, AnOverrideOfNothingNamesTheNearest) {
  const std::string text = "components:\n  dwa: {}\n  amcl: {}\n";
  EXPECT_EQ(error_of(text, {"dwaa.v=1"}),
            "--set dwaa.v=1: no component, variable or launch key 'dwaa'; did you mean 'dwa'?");
  EXPECT_THAT(error_of(text, {"dwa.v"}), HasSubstr("expected key=value"));
}

TEST_F(LaunchFileTest, WrongValuesSayFileLineKeyAndWhatIsExpected) {
  EXPECT_THAT(error_of("domain: 233\n"), HasSubstr("bad.yaml:1: domain: expected a number from 0"));
  EXPECT_THAT(error_of("components:\n  a:\n    restart: {policy: sometimes}\n"),
              HasSubstr("bad.yaml:3: components.a.restart.policy: expected one of always, "
                        "on-failure, never, got 'sometimes'"));
  EXPECT_THAT(error_of("components: [a, b]\n"), HasSubstr("components: expected a mapping"));
  EXPECT_THAT(error_of("components:\n  a: {}\n  b: {}\n  a: {}\n"),
              HasSubstr("bad.yaml:4: key 'components.a' stands here twice"));
}

TEST_F(LaunchFileTest, TheLaunchInForceReadsBackTheSame) {
  const Launch launch = load_launch(
      write("a.yaml",
            "seed: 3\nvariables: {map: \"x y\"}\ncomponents:\n  dwa: {parameters: {v: 1, list: [1, "
            "2]}, after: [amcl]}\n  amcl: {environment: {LEVEL: debug}}\n"),
      {});
  const std::string yaml = config::to_yaml(launch);
  EXPECT_EQ(config::to_yaml(load_launch(write("b.yaml", yaml), {})), yaml);
}

}  // namespace
}  // namespace coop::launcher
