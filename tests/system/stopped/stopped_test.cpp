// Programs that are stopped for longer than the others remember them, and go on. As an experiment:
//   COOP_STOPS="pairs=4 repeats=10 shortest_ms=5000 longest_ms=7000 lease_s=5" stopped_test
// prints how often topics did not flow both ways within 5 s afterwards (docs/chaos.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <sstream>

#include "conversions/time.hpp"
#include "coop_msgs/msg/ComponentStatus.h"
#include "core/atomic_file.hpp"
#include "system/support/listener.hpp"
#include "system/support/running_system.hpp"
#include "system/support/small_system.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace coop::test {
namespace {

using Wall = std::chrono::steady_clock;

constexpr const char* kExperiment = "COOP_STOPS";
/// Nobody forgets anybody.
constexpr milliseconds kShortStop{300};

/// Robots side by side on one domain, stopped for lengths spread evenly between two limits.
struct Stops {
  int pairs = 1;
  int repeats = 1;
  int shortest_ms = 4000;
  int longest_ms = 4000;
  int lease_s = 3;
  int patience_ms = 20000;

  static Stops wanted() {
    Stops stops;
    const char* text = std::getenv(kExperiment);
    if (text == nullptr) return stops;
    stops.patience_ms = 5000;
    const std::map<std::string, int*> keys{{"pairs", &stops.pairs},
                                           {"repeats", &stops.repeats},
                                           {"shortest_ms", &stops.shortest_ms},
                                           {"longest_ms", &stops.longest_ms},
                                           {"lease_s", &stops.lease_s},
                                           {"patience_ms", &stops.patience_ms}};
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      const std::size_t equals = word.find('=');
      *keys.at(word.substr(0, equals)) = std::stoi(word.substr(equals + 1));
    }
    return stops;
  }
  [[nodiscard]] milliseconds length(int i) const {
    return milliseconds(shortest_ms +
                        (repeats > 1 ? (longest_ms - shortest_ms) * i / (repeats - 1) : 0));
  }
};

/// Hears a localiser: its health, and the locations that it tells whenever it hears the laser.
class Ear {
 public:
  Ear(const std::string& robot, const std::string& lease)
      : listener_({.domain = test_domain(),
                   .participant_name = "ear",
                   .partition = robot,
                   .settings = runtime::read_dds_settings({lease})}) {
    listener_.node().subscribe<coop_msgs::msg::ComponentStatus>(
        "component_status", runtime::Qos::kHeartbeat,
        [this](const coop_msgs::msg::ComponentStatus& status) {
          if (status.name() == "amcl") ++heartbeats_;
        });
    listener_.node().subscribe<tf2_msgs::msg::TFMessage>(
        "tf", runtime::Qos::kEvent, [this](const tf2_msgs::msg::TFMessage& message) {
          // Not one of a scan that was found in a socket later.
          const auto time = conversions::from_msg(message.transforms().at(0).header().stamp());
          if (time && *time > since_) ++locations_;
        });
  }

  void look() { listener_.look(); }
  void forget() {
    look();
    heartbeats_ = locations_ = 0;
    since_ = runtime::SystemClock().now();
  }
  /// The localiser is heard.
  [[nodiscard]] bool hears_it() const { return heartbeats_ > 0; }
  /// And it hears the laser.
  [[nodiscard]] bool hears_locations() const { return locations_ > 0; }
  [[nodiscard]] bool hears_all() const { return hears_it() && hears_locations(); }
  bool comes_to_hear_all(milliseconds limit) {
    forget();
    return look_until(
        *this, [this] { return hears_all(); }, limit);
  }

 private:
  Listener listener_;
  int heartbeats_ = 0;
  int locations_ = 0;
  Time since_{};
};

/// A laser and a localiser, which is the one that is stopped.
class Robot {
 public:
  Robot(const std::filesystem::path& folder, int number, int lease_s)
      : folder_(folder),
        name_("robot" + std::to_string(number)),
        lease_("lease=" + std::to_string(lease_s)),
        ear_(name_, lease_),
        laser_(start("lidar_driver")),
        localiser_(start("amcl")) {}

  [[nodiscard]] Ear& ear() { return ear_; }
  void signal(int number) const { localiser_->signal(number); }
  void replace_localiser() {
    localiser_.reset();
    localiser_ = start("amcl");
  }
  [[nodiscard]] std::string output() const { return localiser_->output(); }

 private:
  std::unique_ptr<Program> start(const std::string& part) {
    return std::make_unique<Program>(
        COOP_SMALL_PART,
        std::vector<std::string>{"--name", part, "--robot", name_, "--domain",
                                 std::to_string(test_domain()), "--dds", lease_},
        folder_ / (name_ + "." + part + ".out"));
  }

  std::filesystem::path folder_;
  std::string name_;
  std::string lease_;
  Ear ear_;
  std::unique_ptr<Program> laser_;
  std::unique_ptr<Program> localiser_;
};

/// How often a program has said that it joined anew.
int rejoins(const std::string& output) {
  const std::string what = ": joined anew";
  int count = 0;
  for (auto at = output.find(what); at != std::string::npos; at = output.find(what, at + 1)) {
    ++count;
  }
  return count;
}

class Stopped : public ::testing::Test {
 protected:
  Stopped() {
    for (int i = 0; i < stops_.pairs; ++i) {
      robots_.push_back(std::make_unique<Robot>(folder_.path(), i, stops_.lease_s));
    }
  }

  void look(milliseconds duration) {
    wait_until(
        [this] {
          for (const auto& robot : robots_) robot->ear().look();
          return false;
        },
        duration);
  }
  /// Until every localiser is heard and hears, from now on; when each came to that, at most.
  std::map<const Robot*, double> wait_for_all() {
    std::map<const Robot*, double> heard;
    for (const auto& robot : robots_) robot->ear().forget();
    const auto begin = Wall::now();
    wait_until(
        [&] {
          for (const auto& robot : robots_) {
            robot->ear().look();
            if (robot->ear().hears_all())
              heard.try_emplace(robot.get(),
                                std::chrono::duration<double>(Wall::now() - begin).count());
          }
          return heard.size() == robots_.size();
        },
        milliseconds(stops_.patience_ms));
    return heard;
  }
  void stop_all(milliseconds length) {
    for (const auto& robot : robots_) robot->signal(SIGSTOP);
    look(length);
    for (const auto& robot : robots_) robot->signal(SIGCONT);
  }

  TemporaryFolder folder_;
  Stops stops_ = Stops::wanted();
  std::vector<std::unique_ptr<Robot>> robots_;
};

TEST_F(Stopped, who_was_stopped_for_longer_than_others_remember_is_heard_and_hears_again) {
  ASSERT_EQ(wait_for_all().size(), robots_.size());
  stop_all(kShortStop);
  ASSERT_EQ(wait_for_all().size(), robots_.size());
  for (const auto& robot : robots_) EXPECT_EQ(rejoins(robot->output()), 0) << robot->output();
  std::vector<double> times;
  int lost = 0;
  int heard_only = 0;
  for (int i = 0; i < stops_.repeats; ++i) {
    stop_all(stops_.length(i));
    const auto heard = wait_for_all();
    for (const auto& robot : robots_) {
      if (const auto found = heard.find(robot.get()); found != heard.end()) {
        times.push_back(found->second);
        continue;
      }
      ++lost;
      if (robot->ear().hears_it()) ++heard_only;
      std::printf(
          "stopped for %.2f s: %s\n%s", static_cast<double>(stops_.length(i).count()) * 1e-3,
          robot->ear().hears_it() ? "heard, hears nothing" : "not heard", robot->output().c_str());
      robot->replace_localiser();
    }
    if (heard.size() != robots_.size()) {
      ASSERT_EQ(wait_for_all().size(), robots_.size());
    }
  }
  std::ranges::sort(times);
  std::printf("stopped: %d of %d lost, %d of them heard but deaf; both ways again after: ", lost,
              stops_.repeats * stops_.pairs, heard_only);
  if (!times.empty())
    std::printf("median %.2f s, longest %.2f s", times[times.size() / 2], times.back());
  std::printf("\n");
  EXPECT_EQ(lost, 0);
  if (std::getenv(kExperiment) != nullptr) return;
  EXPECT_EQ(rejoins(robots_[0]->output()), 1) << robots_[0]->output();
}

TEST(StoppedSystem, is_whole_again_where_the_launcher_replaces_nobody_and_was_stopped_itself) {
  const TemporaryFolder folder;
  std::string text = "components:\n";
  for (const char* name : {"lidar_driver", "amcl"}) {
    const std::string component = small_component(folder.path(), name);
    text += component.substr(0, component.rfind('}')) + ", heartbeat_timeout: 60}\n";
  }
  write_file_atomically(folder.path() / "small.yaml", text);
  RunningSystem system(folder.path() / "small.yaml", {"--set", "dds.lease=3"});
  ASSERT_TRUE(system.wait_until_ready());
  Ear ear("", "lease=3");
  ASSERT_TRUE(ear.comes_to_hear_all(kSoon));
  const pid_t localiser = system.row("amcl")->pid;
  const auto signal_both = [&](int number) {
    kill(localiser, number);
    system.launcher().signal(number);
  };
  signal_both(SIGSTOP);
  look_until(
      ear, [] { return false; }, Stops().length(0));
  signal_both(SIGCONT);
  EXPECT_TRUE(ear.comes_to_hear_all(kSoon));
  EXPECT_TRUE(wait_until([&] { return rejoins(system.launcher().output()) == 1; }))
      << system.launcher().output();
  // The launcher hears heartbeats again, since it misses them.
  kill(localiser, SIGSTOP);
  EXPECT_TRUE(system.wait_for_state("amcl", "silent")) << system.launcher().output();
  kill(localiser, SIGCONT);
  EXPECT_TRUE(system.wait_until_ready()) << system.launcher().output();
  EXPECT_EQ(system.row("amcl")->pid, localiser);
}

}  // namespace
}  // namespace coop::test
