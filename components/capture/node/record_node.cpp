#include "capture/node/record_node.hpp"

#include <coop_idl/interface_version.hpp>

#include "capture/node/wire.hpp"
#include "capture/traffic/launch_files.hpp"
#include "conversions/time.hpp"
#include "coop_msgs/msg/LockstepRoster.h"
#include "core/atomic_file.hpp"
#include "core/places.hpp"
#include "rosgraph_msgs/msg/Clock.h"

namespace coop::capture {

using runtime::RawSample;

namespace {

constexpr auto kTick = std::chrono::milliseconds(200);
/// That long after a loss the recorder is degraded; the account of it stays in the file.
constexpr auto kLossIsNews = std::chrono::seconds(10);
/// Less is no other time: who takes up the clock of one that died may be a little behind.
constexpr auto kClockSetBack = std::chrono::seconds(1);
/// Samples that came before the first clock message, at most.
constexpr std::size_t kMostEarly = 100'000;

Time system_now() {
  return runtime::SystemClock().now();
}

/// Whether samples of every writer of the round arrive, and the orders to every member.
bool hears_round(const TrafficTap& tap, const coop_msgs::msg::LockstepRoster& roster) {
  if (!tap.hears_topic("rt/lockstep_roster")) return false;
  std::vector<std::string> writers;
  for (const auto& member : roster.members()) {
    for (const auto& endpoint : member.endpoints()) {
      const bool writes = endpoint.kind() == coop_msgs::msg::LockstepEndpoint_Constants::WRITER;
      if (writes) writers.push_back(endpoint.id());
      const bool is_order = endpoint.topic() == "lockstep_tick/" + member.name();
      if (is_order && !writes && !tap.hears_topic("rt/" + endpoint.topic())) return false;
    }
  }
  return tap.hears_all(writers);
}

std::filesystem::path folder_of(const runtime::Node& node, const RecordConfig& config) {
  return config.output.empty() ? node.options().run_dir / "captures"
                               : std::filesystem::path(config.output);
}

}  // namespace

RecordNode::RecordNode(runtime::Node& node, const Config& config)
    : node_(node),
      config_(config),
      folder_(folder_of(node, config)),
      recording_(config.recording(new_path(""))),
      saver_(node, recording_, config, [this](const std::string& kind) { return new_path(kind); }),
      ring_saver_(node, config) {
  describe_run();
  runtime::Executor& executor = node.executor();
  tap_ = std::make_unique<TrafficTap>(
      raw_options(node.options()), [&executor] { executor.wake(); }, listener());
  executor.add_source(*tap_);
  executor.add_wall_timer(kTick, [this] { tick(); });
  node.hold_rounds_until(
      [this](const coop_msgs::msg::LockstepRoster& roster) { return hears_round(*tap_, roster); });
  node.on_stop([this] { stop(); });
}

RecordNode::~RecordNode() {
  if (tap_) node_.executor().remove_source(*tap_);
}

std::filesystem::path RecordNode::new_path(const std::string& suffix) const {
  const std::string stem = node_.name() + "-" + date_and_time() + suffix;
  auto path = folder_ / (stem + ".mcap");
  // Also the parts of a split capture: NAME_0001.mcap.
  const auto is_taken = [this](const std::string& name) {
    return std::filesystem::exists(folder_ / (name + ".mcap")) ||
           std::filesystem::exists(folder_ / (name + "_0001.mcap"));
  };
  std::string name = stem;
  for (int number = 2; is_taken(name); ++number) name = stem + "-" + std::to_string(number);
  return folder_ / (name + ".mcap");
}

void RecordNode::describe_run() {
  const auto& options = node_.options();
  recording_.note("coop", {{"interface_version", std::to_string(coop_idl::kInterfaceVersion)},
                           {"recorder", options.name},
                           {"robot", options.robot},
                           {"domain", std::to_string(options.domain)},
                           {"clock", options.sim_time ? "simulated" : "system"},
                           {"lockstep", options.lockstep ? "true" : "false"},
                           {"begun", date_and_time()}});
  const auto launch = options.run_dir / "launch.yaml";
  if (!config_.attachments || !std::filesystem::exists(launch)) return;
  try {
    const std::string text = read_file(launch);
    recording_.attach("launch.yaml", "application/yaml", text, system_now());
    for (const auto& file : files_of_launch(text, Places::of_this_program().share)) {
      recording_.attach(file.filename().string(), std::string(media_type_of(file)), read_file(file),
                        system_now());
    }
  } catch (const std::exception& problem) {
    node_.log().warning("attachments: {}", problem.what());
  }
}

RecordNode::Role RecordNode::role_of(const std::string& topic) {
  if (topic == "/clock") return Role::kClock;
  if (topic == "/component_status") return Role::kHeartbeat;
  if (topic == "/emergency_stop") return Role::kEmergencyStop;
  if (topic == "/save_capture") return Role::kSaveOrder;
  return Role::kNone;
}

TrafficTap::Listener RecordNode::listener() {
  return {.wants =
              [this](const runtime::DiscoveredEndpoint& endpoint) {
                const std::string topic = shown_topic(endpoint.topic.name);
                if (topic.starts_with("_fastdds_statistics_")) return false;
                return role_of(topic) != Role::kNone || config_.selection().wants(topic);
              },
          .on_writer = [this](const auto& endpoint) { return add_writer(endpoint); },
          .on_sample =
              [this](const void* writer, const RawSample& sample) {
                receive(*static_cast<const Heard*>(writer), sample);
              },
          .on_gone =
              [this](const void* writer) {
                const auto& heard = *static_cast<const Heard*>(writer);
                if (heard.role != Role::kHeartbeat) return;
                handle_news();  // its last word, a farewell perhaps
                saver_.component_gone(heard.component);
              },
          .on_problem = [this](const std::string& text) { node_.log().warning("{}", text); }};
}

const void* RecordNode::add_writer(const runtime::DiscoveredEndpoint& endpoint) {
  const WriterInfo writer = writer_info(endpoint);
  auto heard = std::make_unique<Heard>();
  heard->role = role_of(writer.topic);
  heard->component = writer.component;
  heard->recorded = config_.selection().wants(writer.topic);
  if (heard->recorded) heard->channel = recording_.add_channel(writer);
  heard_.push_back(std::move(heard));
  return heard_.back().get();
}

Time RecordNode::now() const {
  return node_.options().sim_time ? Time(Duration(sim_now_.load())) : system_now();
}

void RecordNode::receive(const Heard& heard, const RawSample& sample) {
  if (heard.role == Role::kClock && node_.options().sim_time) {
    rosgraph_msgs::msg::Clock message;
    if (runtime::from_wire(sample.bytes, message)) {
      if (const auto time = conversions::from_msg(message)) follow_clock(*time);
    }
  } else if (heard.role != Role::kNone) {
    {
      const std::scoped_lock lock(mutex_);
      news_.push_back({heard.role, sample.bytes});
    }
    node_.executor().wake();
  }
  if (!heard.recorded) return;
  const Time log_time = now();
  if (log_time == Time{}) return keep_early(heard, sample);
  if (!early_.empty()) {
    for (const auto& [writer, kept] : early_) write(*writer, kept, log_time);
    early_.clear();
  }
  write(heard, sample, log_time);
}

void RecordNode::follow_clock(Time time) {
  if (time + kClockSetBack < now()) {
    node_.log().warning("the clock was set back from {:.3f} s to {:.3f} s: a new capture begins",
                        to_seconds(now().time_since_epoch()), to_seconds(time.time_since_epoch()));
    recording_.begin_anew(new_path(""));
  }
  sim_now_ = to_nanoseconds(time);
}

void RecordNode::keep_early(const Heard& heard, const RawSample& sample) {
  if (early_.size() < kMostEarly) early_.emplace_back(&heard, sample);
}

void RecordNode::write(const Heard& heard, const RawSample& sample, Time log_time) {
  recording_.write(heard.channel, sample.sequence, log_time, sample.source_time, sample.bytes);
}

void RecordNode::handle_news() {
  std::vector<News> all;
  {
    const std::scoped_lock lock(mutex_);
    all.swap(news_);
  }
  for (const News& news : all) {
    if (news.role == Role::kHeartbeat) saver_.heartbeat(news.bytes);
    if (news.role == Role::kEmergencyStop) saver_.emergency_stop(news.bytes);
    if (news.role == Role::kSaveOrder) saver_.order(news.bytes);
  }
}

void RecordNode::tick() {
  handle_news();
  saver_.work();
  if (now() != Time{}) recording_.tick(now());
  const auto wall = std::chrono::steady_clock::now();
  if (const std::string losses = losses_text(recording_.report()); losses != losses_) {
    losses_ = losses;
    lost_at_ = wall;
  }
  if (losses_ != told_losses_ && node_.log().is_due("losses", std::chrono::seconds(5))) {
    node_.log().warning("lost so far: {}", losses_);
    told_losses_ = losses_;
  }
  const auto status = recording_.status();
  ring_saver_.tell(status.warning);
  if (!status.error.empty()) {
    node_.set_degraded(status.error);
  } else if (!losses_.empty() && wall - lost_at_ < kLossIsNews) {
    node_.set_degraded("lost: " + losses_);
  } else {
    node_.set_ready();
  }
}

void RecordNode::stop() {
  node_.executor().remove_source(*tap_);
  tap_.reset();
  handle_news();
  saver_.finish();
  ring_saver_.finish();
  recording_.close();
  const auto status = recording_.status();
  const auto report = recording_.report();
  const std::string losses = losses_text(report);
  node_.log().info("{} messages of {} topics {}, {:.1f} MB; lost: {}", status.messages,
                   report.size(),
                   status.files.empty() ? "in memory" : "in " + status.files.back().string(),
                   static_cast<double>(status.bytes) / 1e6, losses.empty() ? "none" : losses);
}

}  // namespace coop::capture
