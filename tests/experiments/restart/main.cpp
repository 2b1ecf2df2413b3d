// How long a component that was killed is away: from SIGKILL until its successor says that it is
// ready, stays so, and was seen at work with inputs from the others; and how quickly the launcher
// notices one that was stopped. The whole robot stands (sim.yaml), or maps (survey.yaml).
//   restart_experiment --rounds 20
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <iostream>

#include "experiments/restart/component_watch.hpp"
#include "system/support/running_system.hpp"

namespace coop::experiments {
namespace {

using test::RunningSystem;
using Seconds = std::chrono::duration<double>;
using std::chrono::milliseconds;

constexpr milliseconds kLimit{60000};
/// Ready for so long: no last word of a constructor that has not looked at its inputs yet.
constexpr milliseconds kStays{700};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

void print_row(const std::string& name, double target, const std::vector<double>& times) {
  if (times.empty()) return;
  fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {} |\n", name, times.size(), median(times),
             *std::ranges::min_element(times), *std::ranges::max_element(times),
             target > 0 ? fmt::format("{:.1f}", target) : "");
  std::fflush(stdout);
}

class Robot {
 public:
  Robot(const std::string& launch, const std::vector<std::string>& settings)
      : system_(std::filesystem::path(COOP_SOURCE_DIR) / "config/launch" / launch, settings),
        watch_(system_.domain()) {}

  bool wait_until(const std::function<bool()>& condition) {
    const auto end = Wall::now() + kLimit;
    while (!condition()) {
      if (Wall::now() > end) return false;
      watch_.look(milliseconds(2));
    }
    return true;
  }

  bool wait_until_ready() { return system_.wait_until_ready(kLimit); }

  /// s, or nothing where it did not come back.
  std::optional<double> kill(const std::string& component) {
    const pid_t before = system_.row(component).value().pid;
    watch_.look(milliseconds(0));
    const auto begin = Wall::now();
    ::kill(before, SIGKILL);
    const bool is_back = wait_until([&] {
      const auto status = watch_.status(component);
      return status && status->pid != before && watch_.is_ready(component) &&
             Wall::now() - status->since > kStays && watch_.successor_at_work(component, begin);
    });
    if (!is_back) return std::nullopt;
    const auto work = *watch_.successor_at_work(component, begin);
    return Seconds(std::max(watch_.status(component)->since, work) - begin).count();
  }

  /// s from SIGSTOP until `ps` says silent; the process goes on afterwards.
  std::optional<double> stop(const std::string& component) {
    const pid_t pid = system_.row(component).value().pid;
    const auto begin = Wall::now();
    ::kill(pid, SIGSTOP);
    const bool is_seen =
        wait_until([&] { return system_.row(component).value().state == "silent"; });
    const auto seen = Wall::now();
    ::kill(pid, SIGCONT);
    if (!is_seen) return std::nullopt;
    (void)wait_until([&] { return system_.row(component).value().state == "ready"; });
    return Seconds(seen - begin).count();
  }

  RunningSystem& system() { return system_; }

 private:
  RunningSystem system_;
  ComponentWatch watch_;
};

/// Failures are forgotten at once, so that one after the other is the first.
std::vector<std::string> settings_for(const std::vector<std::string>& components) {
  std::vector<std::string> settings{"--set", "defaults.restart.within=0.1"};
  for (const std::string& name : components) {
    settings.insert(settings.end(), {"--set", "components." + name + ".restart.within=0.1"});
  }
  return settings;
}

bool measure(Robot& robot, const std::string& component, double target, int rounds) {
  std::vector<double> times;
  for (int i = 0; i < rounds; ++i) {
    const auto time = robot.kill(component);
    if (!time) {
      fmt::print("{} did not come back\n{}\n", component, robot.system().launcher().output());
      return false;
    }
    times.push_back(*time);
  }
  print_row(component, target, times);
  return true;
}

bool measure_standing(int rounds, int stops) {
  const std::vector<std::string> names{"amcl",         "dwa",           "global_planner",
                                       "lidar_driver", "camera_driver", "arm_driver",
                                       "simulator",    "sequencer"};
  Robot robot("sim.yaml", settings_for(names));
  if (!robot.wait_until_ready()) return false;
  for (const std::string& name : names) {
    if (!measure(robot, name, name == "sequencer" ? 2.0 : 1.0, rounds)) return false;
  }
  std::vector<double> seen;
  for (int i = 0; i < stops; ++i) {
    const auto time = robot.stop(names[static_cast<std::size_t>(i) % names.size()]);
    if (!time) return false;
    seen.push_back(*time);
  }
  print_row("one that was stopped is told as silent", 1.1, seen);
  return true;
}

bool measure_mapping(int rounds) {
  Robot robot("survey.yaml", settings_for({"slam", "sequencer"}));
  return robot.wait_until_ready() && measure(robot, "slam", 2.0, rounds);
}

bool measure_start(int rounds) {
  std::vector<double> up;
  std::vector<double> down;
  for (int i = 0; i < rounds; ++i) {
    const auto begin = Wall::now();
    RunningSystem system(std::filesystem::path(COOP_SOURCE_DIR) / "config/launch/sim.yaml");
    if (!system.wait_until_ready(kLimit)) return false;
    up.push_back(Seconds(Wall::now() - begin).count());
    const std::vector<pid_t> pids = system.pids();
    const auto stopping = Wall::now();
    if (!system.stop()) return false;
    down.push_back(Seconds(Wall::now() - stopping).count());
    if (std::ranges::any_of(pids, test::is_alive)) return false;
  }
  print_row("`coop up sim` to all ready", 3.0, up);
  print_row("`coop down`, nothing left", 2.0, down);
  return true;
}

}  // namespace
}  // namespace coop::experiments

int main(int argc, char** argv) {
  int rounds = 20;
  int starts = 10;
  std::string out;
  CLI::App app{"how long a component that was killed is away"};
  app.add_option("--rounds", rounds, "kills of each component")->check(CLI::Range(1, 1000));
  app.add_option("--starts", starts, "starts of the whole robot")->check(CLI::Range(0, 1000));
  app.add_option("-o", out, "not used: the table goes to the terminal");
  CLI11_PARSE(app, argc, argv);
  std::cout << "| | n | median s | min | max | target |\n|---|---|---|---|---|---|\n";
  using namespace coop::experiments;
  try {
    const bool ok =
        measure_standing(rounds, rounds) && measure_mapping(rounds) && measure_start(starts);
    return ok ? 0 : 1;
  } catch (const std::exception& problem) {
    std::cerr << "restart_experiment: " << problem.what() << '\n';
    return 1;
  }
}
