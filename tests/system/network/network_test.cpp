// What a running system offers to a network, and what it makes of garbage.
//   COOP_FUZZ_SECONDS=600 COOP_FUZZ_SEED=7 network_test --gtest_filter='*garbage*'
//   COOP_FORGERY=gap_ahead COOP_FUZZ_PROTECTION=all network_test --gtest_filter='*forged*'
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <thread>

#include "core/atomic_file.hpp"
#include "sensor_msgs/msg/LaserScan.h"
#include "system/network/forgery.hpp"
#include "system/network/garbage.hpp"
#include "system/network/open_sockets.hpp"
#include "system/network/watcher.hpp"
#include "system/support/listener.hpp"
#include "system/support/running_system.hpp"
#include "system/support/small_system.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Wall = std::chrono::steady_clock;

constexpr milliseconds kPatience{60000};
/// The UDP ports of a domain begin at 7400 + 250 * domain; there are 250.
constexpr int kPortBase = 7400;
constexpr int kPortGain = 250;
const std::vector<std::string> kParts{"simulator", "lidar_driver", "amcl"};

int setting(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

class NetworkTest : public ::testing::Test {
 protected:
  /// `protection`: of `coop keys make`; empty: without keys.
  void start(const std::string& protection = "") {
    std::string text = "components:\n";
    for (const std::string& name : kParts) text += small_component(folder_.path(), name);
    if (!protection.empty()) {
      keys_ = folder_.path() / "keys";
      text += "dds: {security: on, keys: \"" + keys_.string() + "\"}\n";
    }
    const auto file = folder_.path() / "small.yaml";
    write_file_atomically(file, text);
    if (!protection.empty()) {
      Program make("keys",
                   {"make", file.string(), "--protection", protection, "--observer", kWatcher,
                    "--domain", std::to_string(test_domain())},
                   folder_.path() / "keys.out");
      const auto status = make.wait(kPatience);
      ASSERT_TRUE(status && status->code == 0) << make.output();
    }
    system_.emplace(file);
    ASSERT_TRUE(system_->wait_until_ready(kPatience)) << system_->launcher().output();
  }
  [[nodiscard]] std::vector<std::uint16_t> rtps_ports() {
    std::vector<std::uint16_t> ports;
    for (const pid_t pid : system_->pids()) {
      for (const OpenSocket& socket : open_sockets(pid)) {
        if (is_rtps(socket)) ports.push_back(socket.port);
      }
    }
    return ports;
  }
  [[nodiscard]] bool is_rtps(const OpenSocket& socket) const {
    const int first = kPortBase + kPortGain * system_->domain();
    return socket.kind == "udp" && socket.port >= first && socket.port < first + kPortGain;
  }

  TemporaryFolder folder_;
  std::filesystem::path keys_;
  std::optional<RunningSystem> system_;
};

TEST_F(NetworkTest, a_running_system_listens_to_rtps_and_nothing_else) {
  start();
  for (const pid_t pid : system_->pids()) {
    const auto sockets = open_sockets(pid);
    EXPECT_FALSE(sockets.empty());
    for (const OpenSocket& socket : sockets) {
      const bool sends_only = socket.kind == "udp" && socket.port >= 32768;
      EXPECT_TRUE(is_rtps(socket) || sends_only)
          << socket.kind << " " << socket.port << " " << socket.name;
    }
  }
  int control = 0;
  for (const OpenSocket& socket : open_sockets(system_->launcher().pid())) {
    if (socket.kind != "unix") {
      EXPECT_EQ(socket.kind, "udp") << socket.port;
      continue;
    }
    ++control;
    if (socket.name.starts_with("@")) {
      EXPECT_THAT(socket.name, StartsWith("@coop/launcher/"));
      continue;
    }
    EXPECT_THAT(socket.name, HasSubstr(control_folder().string()));
    const auto mode = std::filesystem::status(socket.name).permissions();
    EXPECT_EQ(mode, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  }
  EXPECT_EQ(control, 2) << "the lock and the control socket";
}

TEST_F(NetworkTest, what_looks_like_a_shell_command_in_a_launch_file_is_a_text) {
  const auto bait = folder_.path() / "bait";
  const std::string evil = "; touch " + bait.string() + " $(touch " + bait.string() + ") `touch " +
                           bait.string() + "` | touch " + bait.string() + " #";
  const auto file = folder_.path() / "evil.yaml";
  const auto out = folder_.path() / "out";
  write_file_atomically(
      file,
      "variables: {evil: '" + evil +
          "'}\ncomponents:\n"
          "  a: {executable: /usr/bin/env, health: none, arguments: [printf, '%s\\n', '${evil}'],"
          " environment: {EVIL: '${evil}'}, restart: {policy: never}, on_exit: shutdown}\n");
  const auto result = run_launcher(
      {"up", file.string(), "--run-dir", out.string(), "--domain", std::to_string(test_domain())},
      folder_.path());
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_THAT(read_file(out / "latest" / "logs" / "a.log"), HasSubstr(evil));
  EXPECT_FALSE(std::filesystem::exists(bait));
  // As a name or a program it is refused.
  write_file_atomically(file, "components:\n  'a; touch " + bait.string() + "': {}\n");
  EXPECT_EQ(run_launcher({"check", file.string()}, folder_.path()).code, 1);
  write_file_atomically(file,
                        "components:\n  a: {executable: 'true; touch " + bait.string() + "'}\n");
  EXPECT_EQ(run_launcher({"check", file.string()}, folder_.path()).code, 1);
  EXPECT_FALSE(std::filesystem::exists(bait));
}

/// Writers of scans that somebody hears who looks at one robot.
class Visitor {
 public:
  explicit Visitor(const std::string& robot)
      : listener_({.domain = test_domain(), .participant_name = "visitor", .partition = robot}) {
    listener_.node().subscribe<sensor_msgs::msg::LaserScan>(
        "scan", runtime::Qos::kSensorStream,
        [this](const sensor_msgs::msg::LaserScan&, const runtime::MessageInfo& info) {
          ++scans_[std::string(info.writer)];
        });
  }
  /// How many each has told, when one has told thirty.
  std::vector<int> scans() {
    EXPECT_TRUE(wait_until(
        [this] {
          listener_.look();
          return std::ranges::any_of(scans_, [](const auto& heard) { return heard.second >= 30; });
        },
        kPatience));
    std::vector<int> counts;
    for (const auto& [writer, count] : scans_) counts.push_back(count);
    return counts;
  }

 private:
  Listener listener_;
  std::map<std::string, int> scans_;
};

TEST_F(NetworkTest, systems_of_two_robots_on_one_domain_do_not_mix) {
  std::string text = "components:\n";
  for (const std::string& name : kParts) text += small_component(folder_.path(), name);
  const auto file = folder_.path() / "small.yaml";
  write_file_atomically(file, text);
  RunningSystem ducky(file, {"--robot", "ducky"});
  RunningSystem piggy(file, {"--robot", "piggy"});
  for (RunningSystem* system : {&ducky, &piggy}) {
    ASSERT_TRUE(wait_until(
        [system] {
          return system->launcher().output().find("all 3 components ready") != std::string::npos;
        },
        kPatience))
        << system->launcher().output();
  }
  Visitor at_ducky("ducky");
  Visitor at_piggy("piggy");
  EXPECT_EQ(at_ducky.scans().size(), 1U);
  EXPECT_EQ(at_piggy.scans().size(), 1U);
  EXPECT_EQ(ducky.stop().value().code, 0);
  EXPECT_THAT(piggy.launcher().output(), Not(HasSubstr("stopp")));
}

TEST_F(NetworkTest, the_packets_that_end_bare_fast_dds_end_no_component) {
  start();
  const auto before = system_->pids();
  for (const Packet& packet : deadly_packets()) {
    for (const std::uint16_t port : rtps_ports()) Thrower().throw_at(port, packet);
  }
  Watcher watcher(system_->domain());
  EXPECT_TRUE(watcher.hears_data());
  EXPECT_EQ(system_->pids(), before) << system_->launcher().output();
}

class GarbageTest : public NetworkTest {
 protected:
  /// Brings up a system and somebody who watches it; what they say to each other meanwhile.
  void watch(const std::string& protection) {
    start(protection);
    ports_ = rtps_ports();  // before the watcher has any
    EXPECT_GE(ports_.size(), 2 * kParts.size());
    std::thread capture([this] { genuine_ = capture_rtps(ports_, milliseconds(3000)); });
    watcher_.emplace(system_->domain(), keys_);
    EXPECT_TRUE(watcher_->hears_data());
    capture.join();
    EXPECT_FALSE(genuine_.empty());
    watcher_->look();
    watcher_->begin(kParts);
    before_ = system_->pids();
  }
  /// Throws what `next` makes for COOP_FUZZ_SECONDS. Answers how many hearers it made deaf; each is
  /// replaced by a new one.
  int throw_all(const std::function<Packet()>& next) {
    const Thrower thrower;
    const auto end =
        Wall::now() + std::chrono::seconds(setting("COOP_FUZZ_SECONDS", kSuiteSeconds));
    std::size_t thrown = 0;
    int deaf = 0;
    while (Wall::now() < end) {
      for (int i = 0; i < 20; ++i, ++thrown) {
        thrower.throw_at(ports_[thrown % ports_.size()], next());
      }
      watcher_->look();
      if (watcher_->longest_silence() > kTooLong) {
        ++deaf;
        std::printf("garbage: deaf:%s\n", watcher_->silences().c_str());
        watcher_.emplace(system_->domain(), keys_);
        watcher_->begin(kParts);
      }
      wait_until([] { return false; }, milliseconds(5));
    }
    std::printf("garbage: %zu packets thrown, %d hearers made deaf, silences (s):%s\n", thrown,
                deaf, watcher_->silences().c_str());
    EXPECT_EQ(system_->pids(), before_) << system_->launcher().output();
    return deaf;
  }
  int throw_garbage(Garbage::Sender sender) {
    watch(text_setting("COOP_FUZZ_PROTECTION"));
    const int seed = setting("COOP_FUZZ_SEED", 1);
    std::printf("garbage: %zu genuine packets, %zu ports, seed %d\n", genuine_.size(),
                ports_.size(), seed);
    Garbage garbage(genuine_, static_cast<std::uint64_t>(seed), sender);
    return throw_all([&garbage] { return garbage.next(); });
  }

  /// What is made to do harm, of all kinds or of COOP_FORGERY; somebody who comes later must hear
  /// all, too.
  void throw_forged() {
    const std::string only = text_setting("COOP_FORGERY");
    std::vector<Packet> forged;
    for (const NamedForgery& forgery : forgeries()) {
      if (!only.empty() && only != forgery.name) continue;
      const auto packets = forge(forgery.kind, genuine_);
      std::printf("forged: %s: %zu packets\n", forgery.name.c_str(), packets.size());
      forged.insert(forged.end(), packets.begin(), packets.end());
    }
    ASSERT_FALSE(forged.empty());
    std::mt19937 random(static_cast<unsigned>(setting("COOP_FUZZ_SEED", 1)));
    EXPECT_EQ(throw_all([&] { return forged[random() % forged.size()]; }), 0);
    EXPECT_TRUE(watcher_->hears_data(milliseconds(20000))) << system_->launcher().output();
    Watcher newcomer(system_->domain(), keys_);
    EXPECT_TRUE(newcomer.hears_data(milliseconds(20000))) << "somebody who comes later";
  }

  static std::string text_setting(const char* name) {
    const char* text = std::getenv(name);
    return text == nullptr ? "" : text;
  }

  static constexpr double kTooLong = 5.0;  // s without something that is told all the time
  /// Long enough for somebody to be deaf that long.
  static constexpr int kSuiteSeconds = 8;
  std::vector<std::uint16_t> ports_;
  std::vector<Packet> genuine_;
  std::vector<pid_t> before_;
  std::optional<Watcher> watcher_;
};

TEST_F(GarbageTest, garbage_at_its_ports_neither_kills_nor_silences_a_component) {
  if (geteuid() != 0) GTEST_SKIP() << "not run: capturing packets needs root";
  EXPECT_EQ(throw_garbage(Garbage::Sender::kStranger), 0);
  EXPECT_TRUE(watcher_->hears_data()) << system_->launcher().output();
}

TEST_F(GarbageTest, garbage_in_the_name_of_a_component_neither_kills_nor_silences_one) {
  if (geteuid() != 0) GTEST_SKIP() << "not run: capturing packets needs root";
  EXPECT_EQ(throw_garbage(Garbage::Sender::kForged), 0);
  EXPECT_TRUE(watcher_->hears_data()) << system_->launcher().output();
}

TEST_F(GarbageTest, what_is_forged_to_make_others_deaf_does_not) {
  if (geteuid() != 0) GTEST_SKIP() << "not run: capturing packets needs root";
  watch(text_setting("COOP_FUZZ_PROTECTION"));
  throw_forged();
}

TEST_F(GarbageTest, what_is_forged_where_all_is_encrypted_makes_nobody_deaf) {
  if (geteuid() != 0) GTEST_SKIP() << "not run: capturing packets needs root";
  watch("all");
  throw_forged();
}

}  // namespace
}  // namespace coop::test
