#pragma once
#include <sys/types.h>

#include <cstdint>
#include <map>
#include <optional>

#include "launcher/health.hpp"

namespace coop::launcher {

struct Usage {
  double cpu = 0.0;            ///< share of one processor since the sample before, 1 = one core
  double cpu_seconds = 0.0;    ///< since the process started
  std::uint64_t resident = 0;  ///< bytes
};

/// s for which the main thread of a process could have run and had no processor, since it was
/// started. Nothing where the process is gone or the kernel does not count it.
[[nodiscard]] std::optional<double> starved_seconds(pid_t pid);

/// Processor and memory use of processes, from /proc.
class UsageMeter {
 public:
  /// Nothing where the process is gone.
  std::optional<Usage> sample(pid_t pid, Instant now);

 private:
  struct Last {
    Instant when;
    double cpu_seconds;
    double cpu;
  };
  std::map<pid_t, Last> last_;
};

}  // namespace coop::launcher
