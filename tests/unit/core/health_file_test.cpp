#include "core/health_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "core/atomic_file.hpp"
#include "core/runtime_folder.hpp"
#include "support/temporary_folder.hpp"

namespace coop {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kSecond = 1'000'000'000;

class HealthFileTest : public ::testing::Test {
 protected:
  HealthFileTest() { setenv("COOP_RUNTIME_DIR", room().c_str(), 1); }
  ~HealthFileTest() override { unsetenv("COOP_RUNTIME_DIR"); }
  [[nodiscard]] std::filesystem::path room() const { return folder_.path() / "run"; }
  test::TemporaryFolder folder_;
};

TEST_F(HealthFileTest, WhatAComponentSaysIsFoundUnderItsSystemAndName) {
  const std::int64_t before = boot_time();
  HealthFile file("ducky", 7, "lidar_driver");
  file.write("degraded", "no scan\nfor 0.5 s");
  const auto found = find_health({}, {});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].system, "7-ducky");
  EXPECT_EQ(found[0].component, "lidar_driver");
  EXPECT_EQ(found[0].note.state, "degraded");
  EXPECT_EQ(found[0].note.reason, "no scan for 0.5 s");
  EXPECT_EQ(found[0].note.pid, getpid());
  EXPECT_GE(found[0].note.stamp, before);
  EXPECT_LE(found[0].note.stamp, boot_time());
}

TEST_F(HealthFileTest, SystemsOfOtherDomainsAndRobotsAreToldApart) {
  HealthFile here("", 7, "dwa");
  HealthFile there("ducky", 7, "dwa");
  HealthFile elsewhere("ducky", 17, "dwa");
  for (HealthFile* file : {&here, &there, &elsewhere}) file->write("ready", "");
  EXPECT_THAT(find_health({}, {}), SizeIs(3));
  EXPECT_THAT(find_health(7, {}), SizeIs(2));
  EXPECT_THAT(find_health(7, ""), SizeIs(1));
  EXPECT_THAT(find_health({}, "ducky"), SizeIs(2));
  EXPECT_THAT(find_health(1, {}), IsEmpty());
}

TEST_F(HealthFileTest, AComponentThatEndsInOrderTakesItsFileAway) {
  {
    HealthFile file("", 0, "dwa");
    file.write("ready", "");
    EXPECT_THAT(find_health({}, {}), SizeIs(1));
  }
  EXPECT_THAT(find_health({}, {}), IsEmpty());
  EXPECT_TRUE(std::filesystem::is_empty(room()));
}

TEST_F(HealthFileTest, WithoutAFolderNothingIsWrittenAndOneLineSaysWhy) {
  std::ofstream(room()) << "a file stands where the folder should";
  HealthFile file("", 0, "dwa");
  file.write("ready", "");
  EXPECT_THAT(file.problem(), ::testing::HasSubstr("COOP_RUNTIME_DIR"));
  EXPECT_THAT(find_health({}, {}), IsEmpty());
}

TEST_F(HealthFileTest, AFolderThatGoesAwayDisturbsNobodyAndIsForgottenWhenItIsBack) {
  HealthFile file("", 0, "dwa");
  std::filesystem::remove_all(room());
  file.write("ready", "");
  EXPECT_THAT(file.problem(), ::testing::HasSubstr("cannot write"));
  ASSERT_TRUE(make_private_folder(room()));
  file.write("ready", "");
  EXPECT_EQ(file.problem(), "");
  EXPECT_THAT(find_health({}, {}), SizeIs(1));
}

TEST_F(HealthFileTest, ANameThatIsNoFileNameIsNotWritten) {
  for (const char* name : {"../dwa", "a/b", "", ".dwa", "-x"}) {
    HealthFile file("", 0, name);
    file.write("ready", "");
    EXPECT_NE(file.problem(), "") << name;
  }
  HealthFile file("../../etc", 0, "dwa");
  EXPECT_NE(file.problem(), "");
}

TEST_F(HealthFileTest, AFolderOpenToOthersIsNotUsed) {
  std::filesystem::create_directory(room());
  chmod(room().c_str(), 0755);
  EXPECT_FALSE(make_private_folder(room()));
  chmod(room().c_str(), 0700);
  EXPECT_TRUE(make_private_folder(room()));
}

TEST_F(HealthFileTest, FilesThatAreNoNotesArePassedOver) {
  ASSERT_TRUE(make_private_folder(room()));
  const std::string note = "state ready\nreason \npid 1\nstamp 5\n";
  for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
           {"0.half.state", note.substr(0, 20)},
           {"0.long.state", note + "reason " + std::string(5000, 'x') + "\n"},
           {"0.letters.state", "state ready\npid one\nstamp 5\n"},
           {"x.system.state", note},
           {"0.state", note},
           {".0.dwa.state.12.tmp", note},
           {"0.other.txt", note}}) {
    std::ofstream(room() / name) << text;
  }
  EXPECT_THAT(find_health({}, {}), IsEmpty());
  std::ofstream(room() / "0.good.state") << note;
  EXPECT_THAT(find_health({}, {}), SizeIs(1));
}

TEST(HealthNote, StateStandsWhileTheWriterLivesAndIsHeard) {
  const auto judge = [](const std::string& state, std::int64_t age, bool lives = true) {
    return judge_health({state, "", 1, 100 * kSecond}, 100 * kSecond + age, lives);
  };
  EXPECT_EQ(judge("ready", 0), Liveness::kReady);
  EXPECT_EQ(judge("degraded", kSecond), Liveness::kDegraded);
  EXPECT_EQ(judge("starting", kSecond), Liveness::kStarting);
  EXPECT_EQ(judge("stopping", 0), Liveness::kStopping);
  EXPECT_EQ(judge("finished", 0), Liveness::kStopping);
  EXPECT_EQ(judge("ready", kHealthStaleAfter), Liveness::kReady);
  EXPECT_EQ(judge("ready", kHealthStaleAfter + 1), Liveness::kStale);
  EXPECT_EQ(judge("ready", -1), Liveness::kStale) << "a stamp of an earlier boot";
  EXPECT_EQ(judge("ready", 0, false), Liveness::kAbsent);
}

}  // namespace
}  // namespace coop
