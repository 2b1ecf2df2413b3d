#include "launcher/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace coop::launcher {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class PlanTest : public ::testing::Test {
 protected:
  PlanTest() {
    places_ = {.programs = folder_.path() / "bin", .share = folder_.path() / "share"};
    for (const char* name : {"a", "b", "c", "simulator"}) {
      const auto program = places_.programs / name;
      write_file_atomically(program, "#!/bin/sh\n");
      chmod(program.c_str(), 0755);
    }
    write_file_atomically(places_.share / "config" / "b.yaml", "");
  }
  Plan plan(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
    const auto file = folder_.path() / "launch" / "x.yaml";
    write_file_atomically(file, yaml);
    return make_plan(load_launch(file, overrides), places_, "/run/here");
  }
  std::string error_of(const std::string& yaml) {
    try {
      (void)plan(yaml);
    } catch (const config::Error& error) {
      return std::string(error.what()).substr(folder_.path().string().size());
    }
    return "no error";
  }
  static std::vector<std::string> names(const Plan& plan) {
    std::vector<std::string> out;
    for (const auto& component : plan.components) out.push_back(component.name);
    return out;
  }
  test::TemporaryFolder folder_;
  Places places_;
};

TEST_F(PlanTest, OrderIsAsDeclaredUnlessAfterSaysOtherwise) {
  const Plan plan_ = plan("components:\n  a: {after: [c]}\n  b: {}\n  c: {}\n");
  EXPECT_THAT(names(plan_), ElementsAre("c", "a", "b"));
  EXPECT_THAT(plan_.components[1].after, ElementsAre(0));
  EXPECT_THAT(plan_.components[2].after, IsEmpty());
}

TEST_F(PlanTest, ADisabledComponentIsLeftOutAndNobodyWaitsForIt) {
  const Plan plan_ = plan("components:\n  a: {enabled: false}\n  b: {after: [a]}\n");
  EXPECT_THAT(names(plan_), ElementsAre("b"));
  EXPECT_THAT(plan_.components[0].after, IsEmpty());
}

TEST_F(PlanTest, ComponentsThatWaitForEachOtherAreNamed) {
  EXPECT_EQ(error_of("components:\n  a: {after: [b]}\n  b: {after: [c]}\n  c:\n    after: [a]\n"),
            "/launch/x.yaml:2: after: components wait for each other: a -> b -> c -> a");
}

TEST_F(PlanTest, AnUnknownComponentInAfterNamesTheNearest) {
  EXPECT_EQ(error_of("components:\n  simulator: {}\n  a:\n    after: [simulatr]\n"),
            "/launch/x.yaml:4: a: after: no component 'simulatr'; did you mean 'simulator'?");
}

TEST_F(PlanTest, AMissingProgramOrFileIsFoundBeforeAnythingStarts) {
  EXPECT_THAT(error_of("components:\n  dwa: {}\n"),
              HasSubstr("x.yaml:2: dwa: executable: no program 'dwa' in"));
  EXPECT_THAT(error_of("components:\n  a: {config: config/none.yaml}\n"),
              HasSubstr("x.yaml:2: a: config: no file 'config/none.yaml'"));
  EXPECT_THAT(error_of("dds: {profiles: none.xml}\ncomponents:\n  a: {}\n"),
              HasSubstr("dds.profiles: no file 'none.xml'"));
  EXPECT_THAT(error_of("robot: x\n"), HasSubstr("nothing to start"));
}

TEST_F(PlanTest, NamesThatCouldBePathsOrOptionsAreRefused) {
  EXPECT_THAT(error_of("components:\n  ../a: {executable: a}\n"), HasSubstr("is no name"));
  EXPECT_THAT(error_of("components:\n  -a: {executable: a}\n"), HasSubstr("is no name"));
  EXPECT_THAT(error_of("robot: a/b\ncomponents:\n  a: {}\n"), HasSubstr("robot: 'a/b' is no name"));
}

TEST_F(PlanTest, TheCommandLineCarriesWhatHoldsForAllAndTheParameters) {
  const Plan plan_ = plan(
      "robot: ducky\ndomain: 4\nuse_sim_time: true\nseed: 8\ncomponents:\n  b: {parameters: {v: 1, "
      "deep: {x: \"1\"}}, arguments: [--verbose]}\n");
  EXPECT_THAT(plan_.components[0].arguments,
              ElementsAre("--name", "b", "--robot", "ducky", "--domain", "4", "--seed", "8",
                          "--run-dir", "/run/here", "--log-dir", "/run/here/logs", "--sim-time",
                          "--config", (places_.share / "config/b.yaml").string(), "--set", "v=1",
                          "--set", "deep.x=\"1\"", "--verbose"));
}

TEST_F(PlanTest, SettingsOfTheMiddlewareReachEveryComponentAndTheLauncher) {
  const Plan plan_ = plan(
      "variables: {planner: 10.0.0.2}\ndds: {discovery: peers, peers: [\"${planner}\"]}\n"
      "components:\n  a: {}\n  b: {dds: {interfaces: [eth0]}}\n");
  EXPECT_THAT(plan_.dds.peers, ElementsAre("10.0.0.2"));
  const auto& a = plan_.components[0].arguments;
  EXPECT_THAT(a, Contains("discovery=peers"));
  EXPECT_THAT(a, Contains("peers=[\"10.0.0.2\"]"));
  EXPECT_THAT(a, Not(Contains("interfaces=[\"eth0\"]")));
  EXPECT_THAT(plan_.components[1].arguments, Contains("interfaces=[\"eth0\"]"));
  EXPECT_THAT(plan_.components[1].arguments, Contains("discovery=peers"));
}

TEST_F(PlanTest, SettingsOfTheMiddlewareThatDoNotGoTogetherAreOneLine) {
  EXPECT_EQ(error_of("robot: x\ndds: {discovery: server}\ncomponents:\n  a: {}\n"),
            "/launch/x.yaml:2: dds.server: expected ADDRESS:PORT with discovery: server, got ''");
  EXPECT_EQ(error_of("components:\n  a:\n    dds: {interfces: [lo]}\n"),
            "/launch/x.yaml:3: a: dds: unknown key 'interfces'; did you mean 'interfaces'?");
  EXPECT_THAT(error_of("dds: {discovry: simple}\ncomponents:\n  a: {}\n"),
              HasSubstr("unknown key 'dds.discovry'; did you mean 'discovery'?"));
}

TEST_F(PlanTest, AProgramWithoutHeartbeatGetsOnlyItsOwnArguments) {
  const Plan plan_ =
      plan("components:\n  a: {health: none, arguments: [\"${run_dir}/x\", \"${domain}\"]}\n");
  EXPECT_THAT(plan_.components[0].arguments, ElementsAre("/run/here/x", "0"));
}

TEST_F(PlanTest, TheMasterOfTimeIsTheOnlyOneWithoutSimTime) {
  const Plan plan_ = plan("use_sim_time: true\ncomponents:\n  a: {time: system}\n  b:\n");
  EXPECT_THAT(plan_.components[0].arguments, Not(Contains("--sim-time")));
  EXPECT_THAT(plan_.components[1].arguments, Contains("--sim-time"));
}

TEST_F(PlanTest, SwappingAProgramTakesItsUsualConfiguration) {
  const Plan plan_ = plan("variables: {base: b}\ncomponents:\n  base: {executable: \"${base}\"}\n");
  EXPECT_EQ(plan_.components[0].executable, places_.programs / "b");
  EXPECT_THAT(plan_.components[0].arguments, Contains((places_.share / "config/b.yaml").string()));
  const Plan other =
      plan("variables: {base: b}\ncomponents:\n  base: {executable: \"${base}\"}\n", {"base=a"});
  EXPECT_EQ(other.components[0].executable, places_.programs / "a");
  EXPECT_THAT(other.components[0].arguments, Not(Contains("--config")));
}

TEST_F(PlanTest, VariablesAreReplacedEverywhereAndMayUseEarlierOnes) {
  const Plan plan_ = plan(
      "variables: {name: duck, map: \"${share}/maps/${name}.yaml\"}\ncomponents:\n  a: "
      "{parameters: {map: \"${map}\"}, environment: {MAP: \"${name}\"}}\n");
  EXPECT_EQ(plan_.components[0].parameters[0].value,
            "\"" + (places_.share / "maps/duck.yaml").string() + "\"");
  EXPECT_THAT(plan_.components[0].environment, ElementsAre("MAP=duck"));
}

TEST_F(PlanTest, AParameterThatIsOneVariableIsOfItsKind) {
  const Plan plan_ = plan(
      "variables: {rate: 1, name: \"1\"}\ncomponents:\n  a: {parameters: {n: \"${rate}\", t: "
      "\"${name}\", both: \"${rate}${name}\"}}\n");
  EXPECT_EQ(plan_.components[0].parameters[0].value, "1");
  EXPECT_EQ(plan_.components[0].parameters[1].value, "\"1\"");
  EXPECT_EQ(plan_.components[0].parameters[2].value, "\"11\"");
}

TEST_F(PlanTest, AnUnknownVariableSaysWhereAndNamesTheNearest) {
  EXPECT_EQ(
      error_of("variables: {map: x}\ncomponents:\n  a:\n    parameters:\n      m: \"${mop}\"\n"),
      "/launch/x.yaml:5: a: m: unknown variable '${mop}'; did you mean 'map'?");
  EXPECT_THAT(error_of("components:\n  a: {parameters: {m: \"${mop\"}}\n"),
              HasSubstr("'${' without '}'"));
}

}  // namespace
}  // namespace coop::launcher
