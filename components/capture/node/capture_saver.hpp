#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "capture/node/record_config.hpp"
#include "capture/traffic/fault_watch.hpp"
#include "capture/traffic/recording.hpp"
#include "coop_msgs/msg/SaveCaptureResult.h"
#include "runtime/node.hpp"

namespace coop::capture {

/// "20260131-140312", local time.
[[nodiscard]] std::string date_and_time();

/// Decides when the ring of a recording is written to disk, and answers those who asked for it. All
/// of it on the executor.
class CaptureSaver {
 public:
  /// `new_path`: where the next one of a kind goes.
  CaptureSaver(runtime::Node& node, Recording& recording, const RecordConfig& config,
               std::function<std::filesystem::path(const std::string& kind)> new_path);

  /// Messages as they came: component_status, emergency_stop, save_capture.
  void heartbeat(const std::vector<std::uint8_t>& bytes);
  void emergency_stop(const std::vector<std::uint8_t>& bytes);
  void order(const std::vector<std::uint8_t>& bytes);
  /// Nobody writes its heartbeats any more.
  void component_gone(const std::string& component);

  /// Now and then.
  void work();
  /// What is planned is written before it returns.
  void finish();

 private:
  struct Save {
    std::chrono::steady_clock::time_point due{};
    std::string reason{};
    std::string request_id{};
    std::filesystem::path path{};
    std::future<std::uint64_t> messages{};
  };
  void plan(const std::optional<std::string>& fault);
  void begin(const std::string& reason, const std::string& request_id,
             std::chrono::nanoseconds delay);
  [[nodiscard]] bool make_room() const;
  void answer(const Save& save, bool success, const std::string& detail);

  runtime::Node& node_;
  Recording& recording_;
  RecordConfig config_;
  std::function<std::filesystem::path(const std::string& kind)> new_path_;
  runtime::Publisher<coop_msgs::msg::SaveCaptureResult> results_;
  FaultWatch faults_;
  bool system_stops_ = false;
  std::optional<Save> save_;
};

}  // namespace coop::capture
