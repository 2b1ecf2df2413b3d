#pragma once
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "runtime/in_process_transport.hpp"
#include "runtime/node.hpp"

namespace coop::test {

/// Shells under test and the test's own publishers and subscribers, joined in process on a clock
/// that only the test moves. Nothing waits: advance() sets the clock forward step by step and runs
/// whatever becomes due.
class ComponentFixture {
 public:
  ComponentFixture() { clock_.set(time_from_seconds(1000.0)); }

  /// Runs a component of type C from now on.
  template <class C>
  C& add(const std::string& name, const typename C::Config& config, runtime::Options options = {}) {
    options.name = name;
    auto& member = members_.emplace_back(options, bus_, clock_);
    auto component = std::make_shared<C>(*member.node, config);
    C& reference = *component;
    member.component = std::move(component);
    if (member.node->health() == runtime::Health::kStarting) member.node->set_ready();
    settle();
    return reference;
  }

  /// The node behind the component `name`, to ask for its health.
  [[nodiscard]] runtime::Node& node_of(const std::string& name) {
    for (auto& member : members_) {
      if (member.node->name() == name) return *member.node;
    }
    throw std::runtime_error("no component " + name);
  }

  /// Takes a component out of the world, without an orderly stop if `crash`.
  void remove(const std::string& name, bool crash = false) {
    for (auto& member : members_) {
      if (member.node && member.node->name() == name && !crash) member.node->stop();
    }
    std::erase_if(members_, [&](const Member& member) { return member.node->name() == name; });
    settle();
  }

  /// The test's own node, for publishers, transforms and subscriptions.
  [[nodiscard]] runtime::Node& tester() {
    if (!tester_) {
      runtime::Options options;
      options.name = "tester";
      tester_ = std::make_unique<Member>(options, bus_, clock_);
    }
    return *tester_->node;
  }

  /// Everything that arrives on the topic from now on (and what is latched).
  template <class Message>
  std::shared_ptr<std::vector<Message>> collect(const std::string& topic, runtime::Qos qos) {
    auto messages = std::make_shared<std::vector<Message>>();
    tester().template subscribe<Message>(
        topic, qos, [messages](const Message& message) { messages->push_back(message); });
    settle();
    return messages;
  }

  [[nodiscard]] Time now() const { return clock_.now(); }

  /// Sets the clock forward in steps and lets everybody run after each.
  void advance(Duration duration, Duration step = std::chrono::milliseconds(10)) {
    const Time end = now() + duration;
    while (now() < end) {
      clock_.set(std::min(end, now() + step));
      settle();
    }
  }

  /// Advances until the condition holds; false when `limit` of simulated time passed first.
  bool advance_until(const std::function<bool()>& condition, Duration limit,
                     Duration step = std::chrono::milliseconds(10)) {
    const Time end = now() + limit;
    while (!condition()) {
      if (now() >= end) return false;
      advance(step, step);
    }
    return true;
  }

  /// Runs until nobody has anything to do at the present time.
  void settle() {
    bool any = true;
    while (any) {
      any = false;
      for (auto& member : members_) any = member.executor->run_once() || any;
      if (tester_) any = tester_->executor->run_once() || any;
    }
  }

  void set_time(Time time) { clock_.set(time); }

 private:
  struct Member {
    Member(const runtime::Options& options, runtime::Transport& bus, const runtime::Clock& clock)
        : executor(std::make_unique<runtime::Executor>(clock)),
          node(std::make_unique<runtime::Node>(options, bus, clock, *executor)) {}
    ~Member() {
      component.reset();
      node.reset();
    }
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;
    std::unique_ptr<runtime::Executor> executor;
    std::unique_ptr<runtime::Node> node;
    std::shared_ptr<void> component;
  };

  runtime::ManualClock clock_;
  runtime::InProcessTransport bus_;
  std::list<Member> members_;
  std::unique_ptr<Member> tester_;
};

}  // namespace coop::test
