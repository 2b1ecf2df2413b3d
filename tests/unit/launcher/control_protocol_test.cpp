#include "launcher/control_protocol.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace coop::launcher {
namespace {

using ::testing::HasSubstr;

TEST(ControlProtocolTest, ARequestComesBackAsItWas) {
  const auto request = decode_request(encode(ControlRequest{"restart", "dwa"}));
  ASSERT_TRUE(request);
  EXPECT_EQ(request->verb, "restart");
  EXPECT_EQ(request->name, "dwa");
}

TEST(ControlProtocolTest, WhatIsNoRequestIsAnError) {
  for (const char* line : {"", "ps", "[1]", "{}", R"({"verb": 3})", R"({"verb":"ps","name":[]})",
                           "\xff\xfe", R"({"verb": "ps")"}) {
    EXPECT_FALSE(decode_request(line)) << line;
  }
}

TEST(ControlProtocolTest, ASystemComesBackAsItWasWhateverBytesADetailHolds) {
  ControlReply reply;
  reply.system = {.robot = "ducky",
                  .domain = 3,
                  .launcher = 99,
                  .launch_file = "a.yaml",
                  .run_folder = "runs/1",
                  .uptime = 12.5,
                  .rows = {{.name = "dwa",
                            .state = "degraded",
                            .pid = 17,
                            .uptime = 2.5,
                            .restarts = 4,
                            .cpu = 0.25,
                            .resident = 30'000'000,
                            .detail = "no scan \n \"for\" 0.5 s"}}};
  const auto back = decode_reply(encode(reply));
  ASSERT_TRUE(back);
  ASSERT_EQ(back->system.rows.size(), 1U);
  EXPECT_EQ(back->system.rows[0].detail, reply.system.rows[0].detail);
  EXPECT_EQ(back->system.rows[0].resident, 30'000'000U);
  EXPECT_EQ(back->system.run_folder, "runs/1");
  reply.system.rows[0].detail = "\xff broken";
  EXPECT_TRUE(decode_reply(encode(reply)));
  EXPECT_FALSE(decode_reply("{}"));
}

TEST(ControlProtocolTest, AnEncodedRequestIsOneLine) {
  EXPECT_EQ(encode(ControlRequest{"stop", "a\nb"}).find('\n'), std::string::npos);
}

TEST(SystemViewTest, TheTableHoldsEveryComponentAndTheSums) {
  SystemView system{.robot = "",
                    .domain = 3,
                    .launcher = 99,
                    .launch_file = "a.yaml",
                    .run_folder = "runs/1",
                    .uptime = 3725,
                    .rows = {}};
  system.rows.push_back({.name = "dwa",
                         .state = "ready",
                         .pid = 17,
                         .uptime = 65,
                         .restarts = 1,
                         .cpu = 0.254,
                         .resident = 30'400'000,
                         .detail = ""});
  system.rows.push_back({.name = "a_component_with_a_long_name",
                         .state = "failed",
                         .pid = 0,
                         .uptime = 0,
                         .restarts = 5,
                         .cpu = 0,
                         .resident = 0,
                         .detail = "exit code 7"});
  const auto lines = format_table(system, 200);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0], "coop  domain 3  up 1:02:05  runs/1");
  EXPECT_EQ(
      lines[2],
      "dwa                           ready             17      1:05         1     25      30");
  EXPECT_THAT(lines[3], HasSubstr("failed             -         -         5      -       -  exit"));
  EXPECT_THAT(lines[4], HasSubstr("25      30"));
  for (const auto& line : format_table(system, 40)) EXPECT_LE(line.size(), 40U);
}

}  // namespace
}  // namespace coop::launcher
