#pragma once
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coop_msgs/msg/ComponentStatus.h"
#include "sensor_msgs/msg/LaserScan.h"
#include "system/support/listener.hpp"
#include "system/support/running_system.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace coop::test {

/// Keys of whom a watcher takes where there are some.
inline constexpr const char* kWatcher = "watcher";

/// When something was heard last, and how long it was not.
class Silence {
 public:
  void heard() {
    longest_ = longest();
    last_ = std::chrono::steady_clock::now();
  }
  void begin() {
    longest_ = 0.0;
    last_ = std::chrono::steady_clock::now();
  }
  /// In seconds, the present one included.
  [[nodiscard]] double longest() const {
    if (!last_) return 0.0;
    return std::max(
        longest_, std::chrono::duration<double>(std::chrono::steady_clock::now() - *last_).count());
  }

 private:
  std::optional<std::chrono::steady_clock::time_point> last_;
  double longest_ = 0.0;
};

/// Who watches a system under fire, without being a target.
class Watcher {
 public:
  explicit Watcher(int domain, const std::filesystem::path& keys = {})
      : listener_(options(domain, keys)) {
    listener_.node().subscribe<coop_msgs::msg::ComponentStatus>(
        "component_status", runtime::Qos::kHeartbeat,
        [this](const coop_msgs::msg::ComponentStatus& status) {
          silences_[status.name()].heard();
        });
    listener_.node().subscribe<sensor_msgs::msg::LaserScan>("scan", runtime::Qos::kSensorStream,
                                                            [this](const auto&) {
                                                              ++scans_;
                                                              silences_["scan"].heard();
                                                            });
    listener_.node().subscribe<tf2_msgs::msg::TFMessage>("tf", runtime::Qos::kEvent,
                                                         [this](const auto&) {
                                                           ++locations_;
                                                           silences_["tf"].heard();
                                                         });
  }
  void look() { listener_.look(); }
  /// From now on it counts when one of these components is not heard.
  void begin(const std::vector<std::string>& components) {
    for (const char* topic : {"scan", "tf"}) silences_[topic].begin();
    for (const std::string& name : components) silences_[name].begin();
  }
  /// Of the heartbeats of any, the scans and the locations, in seconds.
  [[nodiscard]] double longest_silence() const {
    double longest = 0.0;
    for (const auto& [name, silence] : silences_) longest = std::max(longest, silence.longest());
    return longest;
  }
  [[nodiscard]] std::string silences() const {
    std::string text;
    for (const auto& [name, silence] : silences_) {
      char entry[64];
      std::snprintf(entry, sizeof entry, " %s %.1f", name.c_str(), silence.longest());
      text += entry;
    }
    return text;
  }
  /// Scans from the laser's part, and locations, which are told for scans heard.
  bool hears_data(milliseconds patience = milliseconds(60000)) {
    listener_.look();
    scans_ = locations_ = 0;
    return look_until(
        listener_, [this] { return scans_ >= 20 && locations_ >= 20; }, patience);
  }

 private:
  static runtime::DdsOptions options(int domain, const std::filesystem::path& keys) {
    runtime::DdsOptions options{.domain = domain, .participant_name = kWatcher, .partition = {}};
    options.settings = runtime::read_dds_settings({});
    options.settings.security = !keys.empty();
    options.settings.keys = keys;
    return options;
  }
  Listener listener_;
  std::map<std::string, Silence> silences_;
  int scans_ = 0;
  int locations_ = 0;
};

}  // namespace coop::test
