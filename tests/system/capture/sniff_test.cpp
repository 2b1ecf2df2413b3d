// Topics are seen on the wire by the tools people have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "system/capture/capture_support.hpp"

namespace coop::test {
namespace {

/// `coop sniff` without the front door, which would build first.
std::vector<std::string> sniff(const std::vector<std::string>& arguments) {
  std::vector<std::string> all{
      "-c", "die() { echo \"$*\" >&2; exit 1; }; programs=$1; . \"$2\"; shift 2; verb_sniff \"$@\"",
      "sniff", COOP_BIN_DIR, COOP_FRONT_DOOR "/traffic.sh"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

bool may_capture() {
  return std::system(
             "command -v tshark >/dev/null && "
             "tshark -i any -a duration:1 -c 1 -w /dev/null >/dev/null 2>&1") == 0;
}

TEST(Sniff, FindsEveryTopicOfARunningSystemByName) {
  if (!may_capture()) GTEST_SKIP() << "not run: no tshark, or no permission to capture";
  const LaunchText launch(kSmallSystem);
  RunningSystem system(launch.path());
  ASSERT_TRUE(system.wait_for_state("lidar_driver", "ready")) << system.launcher().output();
  Program program(
      "/bin/bash",
      sniff({"--topics", "--domain", std::to_string(system.domain()), "--seconds", "10"}),
      system.folder() / "sniff");
  const auto status = program.wait(std::chrono::seconds(60));
  ASSERT_TRUE(status && status->code == 0) << program.output();
  for (const char* topic : {"rt/clock", "rt/tf", "rt/tf_static", "rt/odom", "rt/imu", "rt/scan",
                            "rt/map", "rt/ground_truth", "rt/world", "rt/component_status"}) {
    EXPECT_THAT(program.output(), ::testing::HasSubstr(std::string(" ") + topic + " "));
  }
  EXPECT_THAT(program.output(), ::testing::HasSubstr("sensor_msgs::msg::dds_::LaserScan_"));
}

TEST(Sniff, RefusesNonsenseInOneLine) {
  const TemporaryFolder folder;
  for (const auto& wrong : std::vector<std::vector<std::string>>{
           {"--domain", "x"}, {"--domain", "233"}, {"--what"}, {"none.pcap"}, {"--seconds"}}) {
    Program program("/bin/bash", sniff(wrong), folder.path() / "out");
    const auto status = program.wait();
    ASSERT_TRUE(status);
    EXPECT_EQ(status->code, 1);
    EXPECT_EQ(std::ranges::count(program.output(), '\n'), 1) << program.output();
  }
}

}  // namespace
}  // namespace coop::test
