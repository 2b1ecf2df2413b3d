// A launch that cannot work: one clear line, non-zero exit code, nothing left running.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/atomic_file.hpp"
#include "launcher/supervisor.hpp"
#include "system/support/running_system.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class BadLaunchTest : public ::testing::Test {
 protected:
  /// `coop up sim` with something wrong; its one line.
  std::string refusal(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"up",        COOP_SOURCE_DIR "/config/launch/sim.yaml",
                                       "--domain",  std::to_string(test_domain()),
                                       "--run-dir", (folder_.path() / "runs").string(),
                                       "--timeout", "20",
                                       "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = run_launcher(arguments, folder_.path());
    EXPECT_EQ(result.code, launcher::kExitBadLaunch);
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
    EXPECT_TRUE(!std::filesystem::exists(folder_.path() / "runs") ||
                std::filesystem::is_empty(folder_.path() / "runs"))
        << "something was started";
    return result.output;
  }
  TemporaryFolder folder_;
};

TEST_F(BadLaunchTest, AMisspeltKey) {
  EXPECT_THAT(refusal({"--set", "dwa.max_vel_xx=0.4"}),
              AllOf(HasSubstr("dwa"), HasSubstr("unknown key 'max_vel_xx'"),
                    HasSubstr("did you mean 'max_vel_x'")));
}

TEST_F(BadLaunchTest, AValueOutOfBounds) {
  EXPECT_THAT(refusal({"--set", "dwa.max_vel_x=-3"}),
              AllOf(HasSubstr("max_vel_x: expected a number"), HasSubstr("got '-3'")));
}

TEST_F(BadLaunchTest, AMissingMap) {
  EXPECT_THAT(refusal({"--set", "map=maps/no_such_map.yaml"}),
              AllOf(HasSubstr("amcl"), HasSubstr("no_such_map.yaml")));
}

TEST_F(BadLaunchTest, AMissingWorld) {
  EXPECT_THAT(refusal({"--set", "world=maps/no_such_world.yaml"}),
              AllOf(HasSubstr("simulator"), HasSubstr("no_such_world.yaml")));
}

TEST_F(BadLaunchTest, ABrokenUrdf) {
  const auto urdf = folder_.path() / "broken.urdf";
  write_file_atomically(urdf, "<robot name=\"half\"><link name=\"base_link\">");
  EXPECT_THAT(refusal({"--set", "dwa.robot=" + urdf.string()}),
              AllOf(HasSubstr("dwa"), HasSubstr("broken.urdf")));
}

TEST_F(BadLaunchTest, AMissingConfiguration) {
  EXPECT_THAT(refusal({"--set", "components.amcl.config=config/none.yaml"}),
              AllOf(HasSubstr("amcl"), HasSubstr("no file 'config/none.yaml'")));
}

}  // namespace
}  // namespace coop::test
