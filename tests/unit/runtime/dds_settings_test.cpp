#include "runtime/dds_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/config/error.hpp"

namespace coop::runtime {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string complaint_about(const std::vector<std::string>& assignments) {
  try {
    (void)read_dds_settings(assignments);
  } catch (const config::Error& problem) {
    return problem.what();
  }
  return "no error";
}

class DdsSettingsTest : public ::testing::Test {
 protected:
  DdsSettingsTest() { ::unsetenv("COOP_DDS"); }
  ~DdsSettingsTest() override { ::unsetenv("COOP_DDS"); }
};

TEST_F(DdsSettingsTest, the_defaults_deviate_in_nothing) {
  EXPECT_THAT(read_dds_settings({}).assignments(), IsEmpty());
}

TEST_F(DdsSettingsTest, what_is_written_as_assignments_reads_back_the_same) {
  DdsSettings settings;
  settings.discovery = "peers";
  settings.peers = {"10.0.0.2", "planner.barn"};
  settings.peer_participants = 7;
  settings.lease = 5;
  settings.transport = "shm";
  settings.interfaces = {"eth0"};
  settings.security = true;
  settings.keys = "/a folder/with \"quotes\"";
  const DdsSettings back = read_dds_settings(settings.assignments());
  EXPECT_EQ(back.assignments(), settings.assignments());
  EXPECT_EQ(back.keys, settings.keys);
  EXPECT_EQ(back.lease, 5);
  EXPECT_THAT(back.peers, ElementsAre("10.0.0.2", "planner.barn"));
}

TEST_F(DdsSettingsTest, the_command_line_goes_over_the_environment_key_by_key) {
  ::setenv("COOP_DDS", "discovery=server server=10.0.0.1:11811", 1);
  const DdsSettings settings = read_dds_settings({"server=10.0.0.9:11811"});
  EXPECT_EQ(settings.discovery, "server");
  EXPECT_EQ(settings.server, "10.0.0.9:11811");
}

TEST_F(DdsSettingsTest, what_is_wrong_is_one_line_that_says_where_and_what) {
  EXPECT_EQ(complaint_about({"discovry=peers"}),
            "--dds: unknown key 'discovry'; did you mean 'discovery'?");
  EXPECT_THAT(complaint_about({"discovery=magic"}), HasSubstr("--dds: discovery: expected one of"));
  EXPECT_THAT(complaint_about({"discovery"}), HasSubstr("expected key=value"));
  ::setenv("COOP_DDS", "transport=pigeon", 1);
  EXPECT_THAT(complaint_about({}), HasSubstr("COOP_DDS: transport: expected one of"));
}

TEST_F(DdsSettingsTest, settings_that_do_not_go_together_are_refused) {
  EXPECT_THAT(complaint_about({"discovery=peers"}), HasSubstr("dds.peers: expected the addresses"));
  EXPECT_THAT(complaint_about({"peers=[10.0.0.2]"}), HasSubstr("with discovery: peers only"));
  EXPECT_THAT(complaint_about({"discovery=server"}),
              HasSubstr("dds.server: expected ADDRESS:PORT"));
  EXPECT_THAT(complaint_about({"discovery=server", "server=10.0.0.1"}),
              HasSubstr("got '10.0.0.1'"));
  EXPECT_THAT(complaint_about({"discovery=server", "server=10.0.0.1:99999"}),
              HasSubstr("ADDRESS:PORT"));
  EXPECT_THAT(complaint_about({"server=10.0.0.1:11811"}), HasSubstr("with discovery: server only"));
  EXPECT_THAT(complaint_about({"security=on"}), HasSubstr("dds.keys: expected a folder"));
}

}  // namespace
}  // namespace coop::runtime
