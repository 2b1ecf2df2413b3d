#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "launcher/supervisor.hpp"

namespace coop::launcher {

using namespace std::chrono_literals;

/// Writes down what the supervisor asks for.
class FakeHost : public ProcessHost {
 public:
  Result<pid_t> start(const PlannedComponent& component) override {
    calls.push_back("start " + component.name);
    if (unstartable.contains(component.name)) return fail("cannot execute");
    pids[component.name] = ++last_pid;
    names[last_pid] = component.name;
    return last_pid;
  }
  void signal(pid_t pid, int number) override {
    const char* text = number == SIGTERM ? "term " : "kill ";
    calls.push_back(text + names[pid]);
  }
  std::string last_words(const std::string&) const override { return words; }
  std::optional<double> starved(pid_t) const override { return starved_for; }

  std::vector<std::string> take() { return std::exchange(calls, {}); }

  std::vector<std::string> calls;
  std::map<std::string, pid_t> pids;
  std::map<pid_t, std::string> names;
  std::set<std::string> unstartable;
  std::string words;
  std::optional<double> starved_for;
  pid_t last_pid = 100;
};

/// A base that moves as the test says.
class FakeBase : public Base {
 public:
  void halt() override { ++halts; }
  Motion motion() override { return now; }
  int halts = 0;
  Motion now = Motion::kMoving;
};

inline PlannedComponent component(const std::string& name, std::vector<std::size_t> after = {}) {
  PlannedComponent planned;
  planned.name = name;
  planned.after = std::move(after);
  planned.restart = {.policy = "on-failure",
                     .min_backoff = 0.1,
                     .max_backoff = 0.5,
                     .give_up_after = 4,
                     .within = 60.0};
  planned.start_timeout = 10.0;
  planned.heartbeat_timeout = 3.0;
  planned.stop_timeout = 2.0;
  return planned;
}

/// A supervisor on a clock that only the test moves.
class SupervisorTest : public ::testing::Test {
 protected:
  void make(std::vector<PlannedComponent> components, Base* base = nullptr) {
    plan_.components = std::move(components);
    supervisor_.emplace(
        plan_, host_,
        [this](const std::string& name, const std::string& text) {
          reports_.push_back(name + ": " + text);
        },
        base);
    supervisor_->start(now_);
  }
  void beat(const std::string& name, Health health = Health::kReady, std::string detail = "") {
    supervisor_->on_heartbeat({.component = name,
                               .health = health,
                               .detail = std::move(detail),
                               .pid = host_.pids[name],
                               .host = "here"},
                              now_);
  }
  void exits(const std::string& name, int code, int signal = 0) {
    supervisor_->on_exit(host_.pids[name], {.code = code, .signal = signal}, now_);
  }
  void advance(std::chrono::milliseconds time, const std::vector<std::string>& beating = {}) {
    const Instant end = now_ + time;
    while (now_ < end) {
      now_ = std::min<Instant>(end, now_ + 50ms);
      for (const std::string& name : beating) beat(name);
      supervisor_->tick(now_);
    }
  }
  State state(const std::string& name) {
    for (const auto& row : supervisor_->view()) {
      if (row.name == name) return row.state;
    }
    return State::kFailed;
  }

  Plan plan_;
  FakeHost host_;
  std::optional<Supervisor> supervisor_;
  std::vector<std::string> reports_;
  Instant now_{1000s};
};

}  // namespace coop::launcher
