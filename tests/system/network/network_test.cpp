// What a running system offers to a network, and what it makes of garbage.
//   COOP_FUZZ_SECONDS=600 COOP_FUZZ_SEED=7 network_test --gtest_filter='*garbage*'
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>

#include "coop_msgs/msg/ComponentStatus.h"
#include "core/atomic_file.hpp"
#include "sensor_msgs/msg/LaserScan.h"
#include "system/network/garbage.hpp"
#include "system/network/open_sockets.hpp"
#include "system/support/listener.hpp"
#include "system/support/running_system.hpp"
#include "system/support/small_system.hpp"
#include "system/support/test_domain.hpp"
#include "tf2_msgs/msg/TFMessage.h"

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
  void start(const std::string& more = "") {
    std::string text = more + "components:\n";
    for (const std::string& name : kParts) text += small_component(folder_.path(), name);
    const auto file = folder_.path() / "small.yaml";
    write_file_atomically(file, text);
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

/// Who watches a system under fire, without being a target.
class Watcher {
 public:
  explicit Watcher(int domain) : listener_(domain, "watcher") {
    listener_.node().subscribe<coop_msgs::msg::ComponentStatus>(
        "component_status", runtime::Qos::kHeartbeat,
        [this](const coop_msgs::msg::ComponentStatus& status) {
          longest_ = std::max(longest_, silence(status.name()));
          last_[status.name()] = Wall::now();
        });
    listener_.node().subscribe<sensor_msgs::msg::LaserScan>("scan", runtime::Qos::kSensorStream,
                                                            [this](const auto&) { ++scans_; });
    listener_.node().subscribe<tf2_msgs::msg::TFMessage>("tf", runtime::Qos::kEvent,
                                                         [this](const auto&) { ++locations_; });
  }
  void look() { listener_.look(); }
  /// Longest time between two heartbeats of any, in seconds.
  [[nodiscard]] double longest_silence() {
    for (const std::string& name : kParts) longest_ = std::max(longest_, silence(name));
    return longest_;
  }
  /// Scans from the laser's part, and locations, which are told for scans heard.
  bool hears_data() {
    listener_.look();
    scans_ = locations_ = 0;
    return wait_until(
        [this] {
          listener_.look();
          return scans_ >= 20 && locations_ >= 20;
        },
        kPatience);
  }

 private:
  double silence(const std::string& name) {
    const auto found = last_.find(name);
    return found == last_.end()
               ? 0.0
               : std::chrono::duration<double>(Wall::now() - found->second).count();
  }
  Listener listener_;
  std::map<std::string, Wall::time_point> last_;
  double longest_ = 0.0;
  int scans_ = 0;
  int locations_ = 0;
};

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
  /// Throws garbage for COOP_FUZZ_SECONDS. Answers how many hearers it made deaf; each is replaced
  /// by a new one.
  int throw_garbage(Garbage::Sender sender) {
    start();
    const auto ports = rtps_ports();  // before the watcher has any
    EXPECT_GE(ports.size(), 2 * kParts.size());
    watcher_.emplace(system_->domain());
    EXPECT_TRUE(watcher_->hears_data());
    std::vector<Packet> genuine = capture_rtps(ports, milliseconds(2000));
    EXPECT_FALSE(genuine.empty());
    const auto before = system_->pids();
    const int seed = setting("COOP_FUZZ_SEED", 1);
    std::printf("garbage: %zu genuine packets, %zu ports, seed %d\n", genuine.size(), ports.size(),
                seed);
    Garbage garbage(std::move(genuine), static_cast<std::uint64_t>(seed), sender);
    const Thrower thrower;
    const auto end =
        Wall::now() + std::chrono::seconds(setting("COOP_FUZZ_SECONDS", kSuiteSeconds));
    std::size_t thrown = 0;
    int deaf = 0;
    while (Wall::now() < end) {
      for (int i = 0; i < 20; ++i, ++thrown) {
        thrower.throw_at(ports[thrown % ports.size()], garbage.next());
      }
      watcher_->look();
      if (watcher_->longest_silence() > kTooLong) {
        ++deaf;
        watcher_.emplace(system_->domain());
      }
      wait_until([] { return false; }, milliseconds(5));
    }
    std::printf("garbage: %zu packets thrown, %d hearers made deaf\n", thrown, deaf);
    EXPECT_EQ(system_->pids(), before) << system_->launcher().output();
    return deaf;
  }

  static constexpr double kTooLong = 5.0;  // s without a component's heartbeat
  /// Long enough for somebody to be deaf that long.
  static constexpr int kSuiteSeconds = 8;
  std::optional<Watcher> watcher_;
};

TEST_F(GarbageTest, garbage_at_its_ports_neither_kills_nor_silences_a_component) {
  if (geteuid() != 0) GTEST_SKIP() << "not run: capturing packets needs root";
  EXPECT_EQ(throw_garbage(Garbage::Sender::kStranger), 0);
  EXPECT_TRUE(watcher_->hears_data()) << system_->launcher().output();
}

// Who signs with a component's name can make others deaf to it (docs/security.md), but not end it.
TEST_F(GarbageTest, garbage_in_the_name_of_a_component_kills_none) {
  if (geteuid() != 0) GTEST_SKIP() << "not run: capturing packets needs root";
  (void)throw_garbage(Garbage::Sender::kForged);
}

}  // namespace
}  // namespace coop::test
