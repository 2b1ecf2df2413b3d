// Three hosts on a switch: the sensors' (laser and base), the planner's (localisation), and an
// operator's, who listens. Prints the times of docs/hosts.md;
//   COOP_HOSTS_CUT=10 COOP_HOSTS_REPEATS=5 hosts_test
// measures longer cuts, more often.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>

#include "coop_msgs/msg/ComponentStatus.h"
#include "core/atomic_file.hpp"
#include "sensor_msgs/msg/LaserScan.h"
#include "system/hosts/host_network.hpp"
#include "system/support/listener.hpp"
#include "system/support/small_system.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace coop::test {
namespace {

using Wall = std::chrono::steady_clock;
using std::chrono::seconds;

constexpr int kDomain = 57;
constexpr milliseconds kPatience{30000};
/// Longer than the usual lease: both sides have forgotten each other.
constexpr int kShortCut = 7;
/// Longer than the server's lease, not than its clients'.
constexpr int kServedCut = 10;
/// Longer than a lease of 3 s.
constexpr int kGivenUp = 7;
const std::vector<std::string> kComponents{"amcl", "lidar_driver", "simulator"};

int setting(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

double seconds_since(Wall::time_point begin) {
  return std::chrono::duration<double>(Wall::now() - begin).count();
}

void report(const std::string& setup, const std::string& what, std::vector<double> times) {
  std::ranges::sort(times);
  std::printf("hosts: %s: %s: median %.2f s, longest %.2f s of %zu\n", setup.c_str(), what.c_str(),
              times[times.size() / 2], times.back(), times.size());
}

/// Who has joined on the operator's host, with the settings given.
class Operator {
 public:
  Operator(const HostNetwork& network, const std::vector<std::string>& dds)
      : host_(network.space("operator")),
        listener_({.domain = kDomain,
                   .participant_name = "operator",
                   .partition = {},
                   .settings = runtime::read_dds_settings(dds)}) {
    listener_.node().subscribe<coop_msgs::msg::ComponentStatus>(
        "component_status", runtime::Qos::kHeartbeat,
        [this](const coop_msgs::msg::ComponentStatus& status) {
          // Not oneself.
          if (std::ranges::find(kComponents, status.name()) != kComponents.end())
            heard_[status.name()] = status.state();
        });
    listener_.node().subscribe<sensor_msgs::msg::LaserScan>("scan", runtime::Qos::kSensorStream,
                                                            [this](const auto&) { ++scans_; });
    listener_.node().subscribe<tf2_msgs::msg::TFMessage>(
        "tf", runtime::Qos::kEvent, [this](const tf2_msgs::msg::TFMessage& message) {
          for (const auto& transform : message.transforms()) {
            if (transform.header().frame_id() == "map") ++locations_;
          }
        });
  }

  /// Whether it came to that everybody was heard: health of all, scans of the sensors' host, and
  /// the planner's location, told only while it hears the sensors.
  bool hears_all(milliseconds limit = kPatience) {
    forget();
    const bool heard = wait_until(
        [this] {
          listener_.look();
          const bool all = std::ranges::all_of(kComponents, [this](const std::string& name) {
            const auto found = heard_.find(name);
            return found != heard_.end() &&
                   found->second == coop_msgs::msg::ComponentStatus_Constants::READY;
          });
          return all && scans_ > 1 && locations_ > 1;
        },
        limit);
    if (!heard) {
      std::printf("hosts: heard of %zu components, %d scans, %d locations\n", heard_.size(), scans_,
                  locations_);
    }
    return heard;
  }
  /// Neither health nor location for a second, from now.
  bool hears_nothing_of_the_planner(milliseconds limit = kPatience) {
    return wait_until(
        [this] {
          forget();
          wait_until([] { return false; }, milliseconds(1000));
          listener_.look();
          return !heard_.contains("amcl") && locations_ == 0;
        },
        limit);
  }
  [[nodiscard]] bool has_heard_anybody() {
    listener_.look();
    return !heard_.empty();
  }

 private:
  void forget() {
    listener_.look();
    heard_.clear();
    scans_ = locations_ = 0;
  }
  OnHost host_;
  Listener listener_;
  std::map<std::string, int> heard_;
  int scans_ = 0;
  int locations_ = 0;
};

class HostsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string reason = HostNetwork::obstacle(); !reason.empty()) {
      GTEST_SKIP() << "not run: " << reason;
    }
    network_.emplace(std::vector<std::string>{"sensors", "planning", "operator", "server"});
  }

  void start(const std::vector<std::string>& dds) {
    launch("sensors", dds, {"simulator", "lidar_driver"});
    launch("planning", dds, {"amcl"});
  }

  std::string output() {
    std::string all;
    for (const auto& launcher : launchers_) all += launcher->output();
    return all;
  }

  /// Start to matched: somebody joins and hears of everybody.
  void measure_joining(const std::string& setup, const std::vector<std::string>& dds) {
    std::vector<double> times;
    for (int i = 0; i < repeats_; ++i) {
      const auto begin = Wall::now();
      Operator joining(*network_, dds);
      ASSERT_TRUE(joining.hears_all()) << output();
      times.push_back(seconds_since(begin));
    }
    report(setup, "from joining to hearing everybody", times);
  }

  void measure_healing(const std::string& setup, Operator& listening, int cut) {
    std::vector<double> times;
    for (int i = 0; i < repeats_; ++i) {
      const auto begin = Wall::now();
      network_->cut("planning");
      EXPECT_TRUE(listening.hears_nothing_of_the_planner());
      wait_until([] { return false; },
                 seconds(cut) - std::chrono::duration_cast<milliseconds>(Wall::now() - begin));
      network_->join("planning");
      const auto healed = Wall::now();
      ASSERT_TRUE(listening.hears_all()) << output();
      times.push_back(seconds_since(healed));
    }
    report(setup, "from the end of a cut of " + std::to_string(cut) + " s to hearing everybody",
           times);
  }

  std::unique_ptr<Program> start_server() {
    return network_->run(
        "server",
        {"/usr/bin/fast-discovery-server", "-x", COOP_SOURCE_DIR "/config/dds/discovery_server.xml",
         "-i", "0", "-l", network_->address("server"), "-p", "11811", "-b"},
        folder_.path(), "server.out");
  }

  std::optional<HostNetwork> network_;
  TemporaryFolder folder_;
  std::vector<std::unique_ptr<Program>> launchers_;
  int repeats_ = setting("COOP_HOSTS_REPEATS", 1);
  int cut_ = setting("COOP_HOSTS_CUT", kShortCut);

 private:
  void launch(const std::string& host, const std::vector<std::string>& dds,
              const std::vector<std::string>& components) {
    const auto file = folder_.path() / (host + ".yaml");
    std::string text = "components:\n";
    for (const std::string& name : components) text += small_component(folder_.path(), name);
    write_file_atomically(file, text);
    std::vector<std::string> command{std::string(COOP_BIN_DIR) + "/launcher",
                                     "up",
                                     file.string(),
                                     "--domain",
                                     std::to_string(kDomain),
                                     "--run-dir",
                                     (folder_.path() / ("runs_" + host)).string()};
    for (const std::string& assignment : dds) {
      command.insert(command.end(), {"--set", "dds." + assignment});
    }
    launchers_.push_back(network_->run(host, command, folder_.path(), host + ".out"));
  }
};

TEST_F(HostsTest, multicast_finds_everybody_through_cuts_and_loss) {
  start({});
  Operator listening(*network_, {});
  ASSERT_TRUE(listening.hears_all()) << output();
  measure_joining("multicast", {});
  measure_healing("multicast", listening, cut_);
  network_->lose(0.2);
  measure_joining("multicast, one packet in five lost", {});
  EXPECT_TRUE(listening.hears_all());
}

TEST_F(HostsTest, named_peers_find_each_other_where_multicast_is_blocked) {
  network_->block_multicast();
  const std::vector<std::string> dds{"discovery=peers", "peers=[" + network_->address("sensors") +
                                                            "," + network_->address("planning") +
                                                            "," + network_->address("operator") +
                                                            "]"};
  start(dds);
  Operator by_multicast(*network_, {});
  Operator listening(*network_, dds);
  ASSERT_TRUE(listening.hears_all()) << output();
  measure_joining("peers", dds);
  measure_healing("peers", listening, cut_);
  network_->lose(0.2);
  measure_joining("peers, one packet in five lost", dds);
}

TEST_F(HostsTest, without_multicast_and_without_peers_nobody_is_found) {
  network_->block_multicast();
  start({});
  ASSERT_TRUE(wait_until([this] { return output().find("amcl: started") != std::string::npos; },
                         kPatience));
  Operator listening(*network_, {});
  EXPECT_FALSE(listening.hears_all(milliseconds(3000)));
  EXPECT_FALSE(listening.has_heard_anybody());
}

TEST_F(HostsTest, who_was_given_up_by_the_discovery_server_joins_anew) {
  if (access("/usr/bin/fast-discovery-server", X_OK) != 0) {
    GTEST_SKIP() << "not run: no fast-discovery-server (package fastdds-tools)";
  }
  network_->block_multicast();
  const std::vector<std::string> dds{"discovery=server",
                                     "server=" + network_->address("server") + ":11811", "lease=3"};
  const auto server = start_server();
  start(dds);
  Operator listening(*network_, dds);
  ASSERT_TRUE(listening.hears_all()) << output();
  measure_healing("server, lease 3 s", listening, std::max(cut_, kGivenUp));
  measure_joining("server, lease 3 s, after the cut", dds);
  EXPECT_TRUE(listening.hears_all());
}

TEST_F(HostsTest, a_discovery_server_stands_cuts_and_loss_and_may_die_and_come_back) {
  if (access("/usr/bin/fast-discovery-server", X_OK) != 0) {
    GTEST_SKIP() << "not run: no fast-discovery-server (package fastdds-tools)";
  }
  network_->block_multicast();
  const std::vector<std::string> dds{"discovery=server",
                                     "server=" + network_->address("server") + ":11811"};
  auto server = start_server();
  start(dds);
  Operator listening(*network_, dds);
  ASSERT_TRUE(listening.hears_all()) << output();
  measure_joining("server", dds);
  measure_healing("server", listening, std::max(cut_, kServedCut));
  measure_joining("server, after the cut", dds);
  network_->lose(0.2);
  measure_joining("server, one packet in five lost", dds);
  network_->lose_nothing();
  network_->block_multicast();
  server.reset();
  EXPECT_TRUE(listening.hears_all()) << "what was matched goes on without the server";
  Operator late(*network_, dds);
  EXPECT_FALSE(late.hears_all(milliseconds(2000)));
  server = start_server();
  const auto begin = Wall::now();
  ASSERT_TRUE(late.hears_all()) << server->output();
  report("server", "who joined while it was down, from its restart", {seconds_since(begin)});
}

}  // namespace
}  // namespace coop::test
