// Who does not belong gets nothing in and nothing out; who does, works as without keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "core/atomic_file.hpp"
#include "launcher/keys/key_folder.hpp"
#include "runtime/security_keys.hpp"
#include "system/security/guest.hpp"
#include "system/support/running_system.hpp"
#include "system/support/small_system.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Clock = std::chrono::system_clock;
using runtime::KeyFiles;

constexpr const char* kRobot = "ducky";
constexpr auto kHour = std::chrono::hours(1);
constexpr milliseconds kLimit{20000};

fs::path copy_keys(const fs::path& from, const fs::path& to, const std::string& name) {
  fs::create_directories(to);
  fs::copy(from / "public", to / "public", fs::copy_options::recursive);
  fs::copy(from / name, to / name, fs::copy_options::recursive);
  return to;
}

class SecurityTest : public ::testing::Test {
 protected:
  SecurityTest() : keys_(folder_.path() / "keys") {
    write_file_atomically(launch_, "robot: ducky\ndds: {security: on, keys: \"" + keys_.string() +
                                       "\"}\ncomponents:\n" +
                                       small_component(folder_.path(), "simulator") +
                                       small_component(folder_.path(), "lidar_driver"));
  }

  RunningSystem::Result keys_command(const std::vector<std::string>& arguments) {
    Program program("keys", arguments, folder_.path() / "keys.out");
    const auto status = program.wait(kLimit);
    return {status && status->signal == 0 ? status->code : -1, program.output()};
  }
  void make_keys() {
    const auto made = keys_command({"make", launch_.string(), "--observer", "recorder", "--domain",
                                    std::to_string(test_domain())});
    ASSERT_EQ(made.code, 0) << made.output;
  }
  void start() {
    system_.emplace(launch_, std::vector<std::string>{"--robot", kRobot});
    ASSERT_TRUE(wait_until(
        [this] {
          return system_->launcher().output().find("all 2 components ready") != std::string::npos;
        },
        kLimit))
        << system_->launcher().output();
  }
  /// Somebody who belongs hears the system; answers after how many seconds it did.
  std::optional<double> time_to_join() {
    const auto begin = std::chrono::steady_clock::now();
    Guest person("person", kRobot, keys_);
    person.listen_to_scans();
    const bool hears = wait_until(
        [&] {
          person.look();
          return person.scans() > 0;
        },
        kLimit);
    if (!hears) return std::nullopt;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  /// The guest has its chance while one who belongs hears three seconds of scans.
  void expect_kept_out(Guest& guest, const std::string& who) {
    if (!person_) {
      person_.emplace("person", kRobot, keys_);
      person_->listen_to_scans();
    }
    const int before = person_->scans();
    EXPECT_TRUE(wait_until(
        [&] {
          guest.look();
          person_->look();
          return person_->scans() >= before + 60;
        },
        kLimit))
        << "who belongs hears nothing: " << system_->launcher().output();
    EXPECT_EQ(guest.scans(), 0) << who;
    EXPECT_EQ(guest.driven(), 0) << who;
  }
  /// With keys that are good for nothing, one may be refused at once by one's own middleware.
  void expect_no_use(const std::string& name, const fs::path& keys, const std::string& who) {
    std::optional<Guest> guest;
    try {
      guest.emplace(name, kRobot, keys);
      guest->listen_to_scans();
      guest->drive();
    } catch (const std::runtime_error& refused) {
      SUCCEED() << who << ": " << refused.what();
      return;
    }
    expect_kept_out(*guest, who);
    const auto meanwhile = time_to_join();
    guest.reset();
    const auto afterwards = time_to_join();
    std::printf("security: joining while a guest %s knocks: %.2f s; afterwards: %.2f s\n",
                who.c_str(), meanwhile.value_or(-1.0), afterwards.value_or(-1.0));
    EXPECT_TRUE(afterwards) << who;
  }

  TemporaryFolder folder_;
  fs::path keys_;
  fs::path launch_ = folder_.path() / "secure.yaml";
  std::optional<RunningSystem> system_;
  std::optional<Guest> person_;
};

TEST_F(SecurityTest, who_does_not_belong_gets_nothing_in_and_nothing_out) {
  make_keys();
  // Issued by the system's own authority, but run out, or revoked.
  const keys::KeyFolder authority(keys_, Clock::now() - kHour);
  const keys::System system{.domain = test_domain(), .robot = kRobot};
  // With the rights to do what is tried below.
  const keys::Participant driver{.name = "dwa", .program = "dwa"};
  keys::Participant late = driver;
  late.name = "late";
  authority.issue(system, late, Clock::now() - 48 * kHour, Clock::now() - kHour);
  keys::Participant lost = driver;
  lost.name = "lost";
  authority.issue(system, lost, Clock::now() - kHour, Clock::now() + kHour);
  const auto lost_keys = copy_keys(keys_, folder_.path() / "found", "lost");
  fs::remove(KeyFiles(lost_keys, "lost").revoked);
  authority.revoke("lost", Clock::now());
  start();

  Guest nobody("person", kRobot, {});
  nobody.listen_to_scans();
  nobody.drive();
  expect_kept_out(nobody, "without keys");

  const keys::KeyFolder other(folder_.path() / "rogue", Clock::now() - kHour);
  other.write_governance(system, keys::Protection::kData);
  other.issue(system, driver, Clock::now() - kHour, Clock::now() + kHour);
  expect_no_use("dwa", folder_.path() / "rogue", "of a rogue authority");
  expect_no_use("late", keys_, "with an expired certificate");
  expect_no_use("lost", lost_keys, "with a revoked certificate");
}

TEST_F(SecurityTest, a_component_s_keys_open_its_own_topics_only) {
  make_keys();
  start();
  Guest driver("lidar_driver", kRobot, keys_);
  EXPECT_THROW(driver.drive(), std::runtime_error);
  EXPECT_THROW(driver.listen_to_scans(), std::runtime_error);

  // A middleware that does not ask its own permissions: it heeds a governance without access
  // control, and shows the genuine permissions to the others.
  const auto forged = copy_keys(keys_, folder_.path() / "forged", "lidar_driver");
  const KeyFiles files(forged, "lidar_driver");
  const keys::Authority rogue("rogue", Clock::now() - kHour, Clock::now() + kHour);
  std::string governance =
      keys::governance_xml({.domain = test_domain(), .robot = kRobot}, keys::Protection::kData);
  for (const std::string right : {"read", "write"}) {
    const std::string rule = "<enable_" + right + "_access_control>";
    const std::size_t at = governance.find(rule + "true");
    ASSERT_NE(at, std::string::npos);
    governance.replace(at + rule.size(), 4, "false");
  }
  write_file_atomically(files.governance, rogue.sign(governance));
  write_file_atomically(files.permissions_ca,
                        read_file(files.permissions_ca) + rogue.identity().certificate);
  expect_no_use("lidar_driver", forged, "with lidar_driver's keys and a forged governance");
}

TEST_F(SecurityTest, keys_that_are_missing_or_no_good_are_one_line_and_nothing_starts) {
  const auto check = [this] {
    return run_launcher({"check", launch_.string(), "--domain", std::to_string(test_domain())},
                        folder_.path());
  };
  const auto expect_refusal = [&](const std::string& what) {
    const auto result = check();
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.output, HasSubstr(what));
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
  };
  expect_refusal("no such folder; `coop keys make` makes it");
  make_keys();
  EXPECT_EQ(check().code, 0) << check().output;
  const KeyFiles lidar(keys_, "lidar_driver");
  EXPECT_EQ(fs::status(lidar.key).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(fs::status(lidar.key.parent_path()).permissions(), fs::perms::owner_all);

  const std::string key = read_file(lidar.key);
  write_file_atomically(lidar.key, "no key");
  expect_refusal("key.pem: holds no private key");
  write_file_atomically(lidar.key, read_file(KeyFiles(keys_, "simulator").key));
  expect_refusal("is not the key of");
  write_file_atomically(lidar.key, key);
  fs::rename(lidar.permissions, folder_.path() / "elsewhere");
  expect_refusal("permissions.p7s: No such file");
  fs::rename(folder_.path() / "elsewhere", lidar.permissions);

  const auto lidar_keys = keys_command({"revoke", keys_.string(), "lidar_driver"});
  EXPECT_EQ(lidar_keys.code, 0) << lidar_keys.output;
  expect_refusal("no keys of 'lidar_driver'; `coop keys make` makes them");
  make_keys();
  EXPECT_EQ(check().code, 0);

  const keys::KeyFolder authority(keys_, Clock::now());
  authority.issue({.domain = test_domain(), .robot = kRobot},
                  {.name = "lidar_driver", .program = "lidar_driver"}, Clock::now() - 48 * kHour,
                  Clock::now() - kHour);
  expect_refusal("certificate.pem: expired at");
  const auto listed = keys_command({"list", keys_.string()});
  EXPECT_THAT(listed.output, HasSubstr("lidar_driver: expired\n"));
  const auto rotated = keys_command(
      {"rotate", launch_.string(), "lidar_driver", "--domain", std::to_string(test_domain())});
  EXPECT_EQ(rotated.code, 0) << rotated.output;
  EXPECT_EQ(check().code, 0);
}

}  // namespace
}  // namespace coop::test
