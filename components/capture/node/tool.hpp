#pragma once
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "capture/node/traffic_tap.hpp"
#include "runtime/clock.hpp"
#include "runtime/executor.hpp"

namespace CLI {
class App;
}

namespace coop::capture {

/// What the tools for people have in common.
struct ToolOptions {
  int domain = 0;
  std::string robot;
  std::vector<std::string> dds_settings;  ///< KEY=VALUE, as in `dds:` of a launch file
  bool json = false;

  void describe(CLI::App& app);
  [[nodiscard]] runtime::DdsOptions dds(const std::string& name) const;
};

/// A JSON text of a string, with its quotes.
[[nodiscard]] std::string json_text(const std::string& text);

/// Runs callbacks on one thread until Ctrl-C, or until done.
class ToolLoop {
 public:
  ToolLoop();
  [[nodiscard]] runtime::Executor& executor() { return executor_; }
  [[nodiscard]] Time now() const { return clock_.now(); }
  void finish() { done_ = true; }
  void run();

 private:
  runtime::SystemClock clock_;
  runtime::Executor executor_;
  bool done_ = false;
};

/// A sample with what it is of.
struct HeardSample {
  const runtime::DiscoveredEndpoint* writer = nullptr;
  runtime::RawSample sample;
};

/// Samples of the topics that a predicate wants (by shown name), brought to the tool's thread.
class TopicListener : public runtime::InputSource {
 public:
  TopicListener(ToolLoop& loop, const runtime::DdsOptions& options,
                std::function<bool(const std::string& topic)> wants,
                std::function<void(const HeardSample&)> on_sample);
  ~TopicListener() override;
  TopicListener(const TopicListener&) = delete;
  TopicListener& operator=(const TopicListener&) = delete;
  bool handle_one() override;
  [[nodiscard]] bool has_writers() const { return tap_->writers() > 0; }
  /// Shown names of all topics that discovery has told of.
  [[nodiscard]] const std::set<std::string>& known_topics() const { return known_; }

 private:
  ToolLoop& loop_;
  std::function<bool(const std::string&)> wants_;
  std::function<void(const HeardSample&)> on_sample_;
  std::set<std::string> known_;
  std::vector<std::unique_ptr<runtime::DiscoveredEndpoint>> writers_;
  std::mutex mutex_;
  std::vector<HeardSample> samples_;
  std::unique_ptr<TrafficTap> tap_;
};

}  // namespace coop::capture
