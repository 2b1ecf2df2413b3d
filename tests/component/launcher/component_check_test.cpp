#include "launcher/component_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace coop::launcher {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

class ComponentCheckTest : public ::testing::Test {
 protected:
  void add(const std::string& name, const std::string& script,
           std::vector<config::Assignment> parameters = {}) {
    const auto file = folder_.path() / name;
    write_file_atomically(file, "#!/bin/sh\n" + script + "\n");
    chmod(file.c_str(), 0755);
    PlannedComponent planned;
    planned.name = name;
    planned.where = "x.yaml:" + std::to_string(plan_.components.size() + 2);
    planned.executable = file;
    planned.arguments = {"--name", name};
    planned.parameters = std::move(parameters);
    plan_.components.push_back(planned);
  }
  test::TemporaryFolder folder_;
  Plan plan_;
};

TEST_F(ComponentCheckTest, ContentComponentsAreSilent) {
  for (const char* name : {"a", "b", "c", "d", "e"}) add(name, "echo fine");
  EXPECT_THAT(check_components(plan_), IsEmpty());
}

TEST_F(ComponentCheckTest, EachIsAskedWithItsArgumentsAndCheck) {
  add("a", "[ \"$*\" = \"--name a --check\" ]");
  EXPECT_THAT(check_components(plan_), IsEmpty());
}

TEST_F(ComponentCheckTest, ARefusalIsOneLineWithPlaceAndName) {
  add("good", "exit 0");
  add("bad", "echo 'bad: dwa.yaml:3: unknown key' >&2; echo 'more' >&2; exit 1");
  add("mute", "exit 3");
  EXPECT_THAT(check_components(plan_),
              UnorderedElementsAre("x.yaml:3: bad: dwa.yaml:3: unknown key",
                                   "x.yaml:4: mute: --check: exit code 3"));
}

TEST_F(ComponentCheckTest, AParameterTheMessageNamesGivesThePlace) {
  add("bad", "echo \"bad: --set: unknown key 'limits.w'\" >&2; exit 1",
      {{"v", "1", "1", "x.yaml:11"}, {"limits.w", "1", "1", "x.yaml:12"}});
  EXPECT_THAT(check_components(plan_),
              ElementsAre("x.yaml:12: bad: --set: unknown key 'limits.w'"));
}

TEST_F(ComponentCheckTest, AProgramThatTakesNoCommonOptionsIsNotAsked) {
  add("server", "exit 1");
  plan_.components[0].sends_heartbeat = false;
  EXPECT_THAT(check_components(plan_), IsEmpty());
}

TEST_F(ComponentCheckTest, AProgramThatCannotBeExecutedIsARefusal) {
  add("a", "");
  chmod(plan_.components[0].executable.c_str(), 0644);
  const auto refusals = check_components(plan_);
  ASSERT_EQ(refusals.size(), 1U);
  EXPECT_THAT(refusals[0], testing::StartsWith("x.yaml:2: a: cannot execute"));
}

}  // namespace
}  // namespace coop::launcher
