#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "core/health_file.hpp"
#include "runtime/node.hpp"

namespace coop::runtime {

/// The heartbeat: component_status twice a second of wall time and at every change, with pid,
/// processor time, memory, hash of the configuration and version of the interfaces; and in a file,
/// for `coop health`.
class HealthReporter {
 public:
  HealthReporter(const Options& options, std::shared_ptr<Writer> writer);

  /// From now on also leaves the state in a file: a program does, a node of a test does not.
  /// Answers why there is none, one line; empty where all is well.
  std::string leave_file(const Options& options);
  void report(Health health, const std::string& detail);
  void beat();
  /// Where the last beat is half a second ago.
  void beat_if_due();
  [[nodiscard]] Health health() const { return health_; }
  [[nodiscard]] const std::string& detail() const { return detail_; }

 private:
  std::string name_;
  std::string host_;
  std::uint64_t config_hash_ = 0;
  std::shared_ptr<Writer> writer_;
  std::optional<HealthFile> file_;
  Health health_ = Health::kStarting;
  std::string detail_;
  std::chrono::steady_clock::time_point last_beat_{};
};

/// FNV-1a over the configuration file's text and the settings; tells whether two processes run with
/// the same.
[[nodiscard]] std::uint64_t config_hash(const Options& options);

}  // namespace coop::runtime
