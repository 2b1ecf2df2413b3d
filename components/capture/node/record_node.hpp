#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "capture/node/capture_saver.hpp"
#include "capture/node/record_config.hpp"
#include "capture/node/ring_saver.hpp"
#include "capture/node/traffic_tap.hpp"
#include "capture/traffic/recording.hpp"
#include "runtime/node.hpp"

namespace coop::capture {

/// Shell of the recorder: hears everything, takes part in nothing. Samples go from the thread that
/// received them straight into the recording; the executor looks after discovery, faults and the
/// account.
///
/// A message's log time is the component's time at its arrival: under use_sim_time that of the
/// newest clock message, so that a capture is replayed in simulated time; what arrives before the
/// first is kept until then. The publish time is the system time at which it was written.
class RecordNode {
 public:
  using Config = RecordConfig;
  RecordNode(runtime::Node& node, const Config& config);
  ~RecordNode();
  RecordNode(const RecordNode&) = delete;
  RecordNode& operator=(const RecordNode&) = delete;

 private:
  /// What a topic means to the recorder itself.
  enum class Role : std::uint8_t { kNone, kClock, kHeartbeat, kEmergencyStop, kSaveOrder };
  struct Heard {
    std::uint16_t channel = 0;
    bool recorded = false;
    Role role = Role::kNone;
    std::string component;
  };
  struct News {
    Role role = Role::kNone;
    std::vector<std::uint8_t> bytes;
  };
  static Role role_of(const std::string& topic);
  TrafficTap::Listener listener();
  const void* add_writer(const runtime::DiscoveredEndpoint& endpoint);
  void receive(const Heard& heard, const runtime::RawSample& sample);
  void follow_clock(Time time);
  void keep_early(const Heard& heard, const runtime::RawSample& sample);
  void write(const Heard& heard, const runtime::RawSample& sample, Time log_time);
  void handle_news();
  void describe_run();
  void tick();
  void stop();
  [[nodiscard]] Time now() const;
  [[nodiscard]] std::filesystem::path new_path(const std::string& suffix) const;

  runtime::Node& node_;
  Config config_;
  std::filesystem::path folder_;
  Recording recording_;
  CaptureSaver saver_;
  RingSaver ring_saver_;
  std::atomic<std::int64_t> sim_now_{0};  ///< ns; 0 before the first clock message
  std::vector<std::unique_ptr<Heard>> heard_;
  std::mutex mutex_;
  std::vector<News> news_;
  std::vector<std::pair<const Heard*, runtime::RawSample>> early_;
  std::string losses_;  ///< so far
  std::string told_losses_;
  std::chrono::steady_clock::time_point lost_at_{};
  std::unique_ptr<TrafficTap> tap_;
};

}  // namespace coop::capture
