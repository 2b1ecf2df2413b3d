#include "capture/node/tool.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "capture/traffic/topic_names.hpp"
#include "runtime/security_keys.hpp"
#include "runtime/stop_signal.hpp"

namespace coop::capture {
namespace {

/// Samples that wait for the tool's thread, at most: a terminal may be slow.
constexpr std::size_t kMostWaiting = 100'000;
/// Whose keys the tools take in a secured system: those for commands and looks of people.
constexpr const char* kPerson = "person";

}  // namespace

void ToolOptions::describe(CLI::App& app) {
  app.add_option("--domain", domain, "DDS domain, 0 to 232")->check(CLI::Range(0, 232));
  app.add_option("--robot", robot, "robot name; '*': all robots");
  app.add_option(
         "--dds", dds_settings,
         "KEY=VALUE, as in dds: of the launch file (discovery, peers, interfaces, security, "
         "keys ...), over those in COOP_DDS; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  app.add_flag("--json", json, "one JSON object a line");
}

runtime::DdsOptions ToolOptions::dds(const std::string& name) const {
  const auto settings = runtime::read_dds_settings_of(kPerson, dds_settings);
  return {.domain = domain,
          .participant_name = settings.security ? kPerson : name,
          .partition = robot,
          .settings = settings,
          .sees_all_topics = true};
}

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

ToolLoop::ToolLoop() : executor_(clock_) {}

void ToolLoop::run() {
  const runtime::StopSignal stop(executor_);
  while (!done_ && !runtime::StopSignal::requested()) {
    executor_.wait_and_run(std::chrono::milliseconds(500));
  }
}

TopicListener::TopicListener(ToolLoop& loop, const runtime::DdsOptions& options,
                             std::function<bool(const std::string&)> wants,
                             std::function<void(const HeardSample&)> on_sample)
    : loop_(loop), wants_(std::move(wants)), on_sample_(std::move(on_sample)) {
  TrafficTap::Listener listener;
  listener.wants = [this](const runtime::DiscoveredEndpoint& endpoint) {
    const std::string topic = shown_topic(endpoint.topic.name);
    known_.insert(topic);
    return wants_(topic);
  };
  listener.on_writer = [this](const runtime::DiscoveredEndpoint& endpoint) -> const void* {
    return writers_.emplace_back(std::make_unique<runtime::DiscoveredEndpoint>(endpoint)).get();
  };
  listener.on_sample = [this](const void* writer, const runtime::RawSample& sample) {
    {
      const std::scoped_lock lock(mutex_);
      if (samples_.size() >= kMostWaiting) return;
      samples_.push_back({static_cast<const runtime::DiscoveredEndpoint*>(writer), sample});
    }
    loop_.executor().wake();
  };
  listener.on_gone = [](const void*) {};
  listener.on_problem = [](const std::string& text) { std::cerr << text << '\n'; };
  tap_ = std::make_unique<TrafficTap>(
      options, [this] { loop_.executor().wake(); }, std::move(listener));
  loop_.executor().add_source(*this);
}

TopicListener::~TopicListener() {
  loop_.executor().remove_source(*this);
}

bool TopicListener::handle_one() {
  const bool news = tap_->handle_one();
  std::vector<HeardSample> samples;
  {
    const std::scoped_lock lock(mutex_);
    samples.swap(samples_);
  }
  for (const HeardSample& sample : samples) on_sample_(sample);
  return news || !samples.empty();
}

}  // namespace coop::capture
