#include "capture/node/ring_saver.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include "capture/node/capture_saver.hpp"
#include "capture/traffic/kept_files.hpp"

namespace coop::capture {

RingSaver::RingSaver(runtime::Node& node, const RecordConfig& config)
    : node_(node), config_(config) {
  if (config_.last <= 0 || config_.ring_folder.empty()) return;
  thread_ = std::jthread([this] { work(); });
}

void RingSaver::finish() {
  if (thread_.joinable()) thread_.join();
}

void RingSaver::tell(const std::string& warning) {
  if (warning != told_ && !warning.empty()) node_.log().warning("{}", warning);
  told_ = warning;
}

void RingSaver::work() {
  // Of this thread: Linux has a niceness for each. Refused, it is as fast as the others.
  static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 10));
  for (mcap::DeadRing& ring : mcap::DeadRing::all_in(config_.ring_folder)) {
    try {
      write(ring);
    } catch (const std::exception& problem) {
      node_.log().warning("what a recorder left that died stays in {}: {}", ring.folder().string(),
                          problem.what());
    }
  }
}

void RingSaver::write(mcap::DeadRing& ring) {
  const auto folder = ring.origin().parent_path();
  if (std::filesystem::exists(folder) &&
      !keep_newest(folder, node_.name() + "-", "-killed", config_.limits_before(ring.bytes()))) {
    throw std::runtime_error("the disk is too full");
  }
  const auto written =
      ring.write({"coop.saved", {{"reason", "the recorder died"}, {"at", date_and_time()}}},
                 config_.disk_reserve_bytes());
  if (written.path.empty()) return;
  node_.log().warning("a recorder died; capture {}: {} messages of the time before",
                      written.path.string(), written.messages);
}

}  // namespace coop::capture
