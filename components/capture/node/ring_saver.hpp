#pragma once
#include <string>
#include <thread>

#include "capture/mcap/ring_rescue.hpp"
#include "capture/node/record_config.hpp"
#include "runtime/node.hpp"

namespace coop::capture {

/// Makes captures of the rings whose recorders were killed, on a thread of low priority: what is
/// recorded now does not wait for it.
class RingSaver {
 public:
  RingSaver(runtime::Node& node, const RecordConfig& config);
  /// Waits until that is done.
  void finish();
  /// What is wrong with the ring that is recorded now, or nothing: into the log when it changes.
  void tell(const std::string& warning);

 private:
  void work();
  void write(mcap::DeadRing& ring);

  runtime::Node& node_;
  RecordConfig config_;
  std::string told_;
  std::jthread thread_;
};

}  // namespace coop::capture
