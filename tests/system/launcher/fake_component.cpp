// A component that does what its configuration says: good or bad.
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "coop_msgs/msg/MissionStatus.h"
#include "runtime/run.hpp"

namespace {

using coop::runtime::Node;

struct FakeConfig {
  std::string behaviour = "run";
  double delay = 0.0;  ///< s, until it misbehaves
  std::string once;    ///< misbehave only while this file is absent, then make it

  void describe(coop::config::Fields& fields) {
    static constexpr std::array<std::string_view, 11> kBehaviours{
        "run",   "crash_at_start", "crash",    "never_ready",  "hang",          "ignore_sigterm",
        "flood", "finish",         "degraded", "mission_done", "mission_failed"};
    fields.choice("behaviour", behaviour, kBehaviours, {});
    fields.number("delay", delay, {.unit = "s", .min = 0, .max = 100});
    fields.text("once", once, {});
  }
};

[[noreturn]] void hang() {
  for (;;) pause();
}

[[noreturn]] void crash() {
  std::cerr << "about to crash" << std::endl;
  signal(SIGABRT, SIG_DFL);
  std::_Exit(17);
}

class FakeComponent {
 public:
  using Config = FakeConfig;

  FakeComponent(Node& node, const Config& config) : node_(node), behaviour_(config.behaviour) {
    std::cout << "fake component " << node.name() << " starts" << std::endl;
    if (!config.once.empty()) {
      if (std::filesystem::exists(config.once)) behaviour_ = "run";
      std::ofstream(config.once) << "done\n";
    }
    if (behaviour_ == "crash_at_start") crash();
    if (behaviour_ == "never_ready") hang();
    if (behaviour_ == "ignore_sigterm") signal(SIGTERM, SIG_IGN);
    if (behaviour_ == "degraded") node.set_degraded("no input");
    mission_ = node.advertise<coop_msgs::msg::MissionStatus>("mission_status",
                                                             coop::runtime::Qos::kStateLatched);
    due_ = node.now() + coop::seconds(config.delay);
    node.every(std::chrono::milliseconds(20), [this] { step(); });
    node.on_stop(
        [&node] { std::cout << "fake component " << node.name() << " stops" << std::endl; });
  }

 private:
  void step() {
    if (behaviour_ == "flood") flood();
    if (node_.now() < due_ || acted_) return;
    acted_ = true;
    if (behaviour_ == "crash") crash();
    if (behaviour_ == "hang") hang();
    if (behaviour_ == "finish") node_.finish("did what was to be done");
    if (behaviour_ == "mission_done") end_mission(coop_msgs::msg::MissionStatus_Constants::DONE);
    if (behaviour_ == "mission_failed")
      end_mission(coop_msgs::msg::MissionStatus_Constants::FAILED);
  }

  static void flood() {
    static const std::string line = std::string(99, 'x') + "\n";
    for (int i = 0; i < 10000; ++i) std::cout << line;
    std::cout << std::flush;
  }

  void end_mission(std::uint8_t state) {
    coop_msgs::msg::MissionStatus status;
    status.state(state);
    status.detail("five of five");
    mission_.publish(status);
  }

  Node& node_;
  std::string behaviour_;
  coop::Time due_{};
  bool acted_ = false;
  coop::runtime::Publisher<coop_msgs::msg::MissionStatus> mission_;
};

}  // namespace

int main(int argc, char** argv) {
  return coop::runtime::run<FakeComponent>(argc, argv, "fake_component", "misbehaves on demand");
}
