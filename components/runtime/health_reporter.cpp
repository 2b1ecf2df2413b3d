#include "runtime/health_reporter.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <coop_idl/interface_version.hpp>
#include <fstream>
#include <sstream>

#include "conversions/time.hpp"
#include "coop_msgs/msg/ComponentStatus.h"
#include "core/hash.hpp"

namespace coop::runtime {
namespace {

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds_of = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

std::uint64_t resident_bytes() {
  std::ifstream in("/proc/self/statm");
  std::uint64_t pages = 0;
  std::uint64_t resident = 0;
  in >> pages >> resident;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

std::string_view to_string(Health health) {
  switch (health) {
    case Health::kStarting:
      return "starting";
    case Health::kReady:
      return "ready";
    case Health::kDegraded:
      return "degraded";
    case Health::kStopping:
      return "stopping";
    case Health::kFinished:
      return "finished";
  }
  return "";
}

std::uint64_t config_hash(const Options& options) {
  Fnv1a hash;
  const auto mix = [&hash](std::string_view text) {
    hash.add(text);
    hash.add(std::uint8_t{0xFF});
  };
  if (!options.config.empty()) {
    std::ifstream in(options.config, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    mix(text.str());
  }
  for (const std::string& setting : options.settings) mix(setting);
  return hash.value();
}

HealthReporter::HealthReporter(const Options& options, std::shared_ptr<Writer> writer)
    : name_(options.name), config_hash_(config_hash(options)), writer_(std::move(writer)) {
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  host_ = host;
}

std::string HealthReporter::leave_file(const Options& options) {
  file_.emplace(options.robot, options.domain, options.name);
  beat();
  return file_->problem();
}

void HealthReporter::report(Health health, const std::string& detail) {
  if (health == health_ && detail == detail_) return;
  health_ = health;
  detail_ = detail;
  beat();
}

void HealthReporter::beat() {
  coop_msgs::msg::ComponentStatus status;
  status.name(name_);
  // The heartbeat is about the process: system time, also in simulations.
  status.stamp(conversions::to_msg(SystemClock().now()));
  status.state(static_cast<std::uint8_t>(health_));
  status.detail(detail_);
  status.pid(static_cast<std::uint32_t>(::getpid()));
  status.config_hash(config_hash_);
  status.interface_version(static_cast<std::uint32_t>(coop_idl::kInterfaceVersion));
  status.cpu_seconds(cpu_seconds());
  status.rss_bytes(resident_bytes());
  status.host(host_);
  writer_->write(&status);
  if (file_) file_->write(to_string(health_), detail_);
  last_beat_ = std::chrono::steady_clock::now();
}

void HealthReporter::beat_if_due() {
  if (std::chrono::steady_clock::now() - last_beat_ >= std::chrono::milliseconds(500)) beat();
}

}  // namespace coop::runtime
