#pragma once

namespace coop::runtime {

class Executor;

/// SIGINT and SIGTERM ask for an orderly stop; a second one of the kind ends the process at once,
/// as usual. SIGPIPE is ignored. One per process.
class StopSignal {
 public:
  explicit StopSignal(Executor& executor);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  [[nodiscard]] static bool requested();
};

}  // namespace coop::runtime
