#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/chaos/fault.hpp"

namespace coop::chaos {

/// The ground on which the faults happen: a network namespace with nothing but `lo`, and a small
/// tmpfs for the runs' folders; nobody else on the machine notices anything. Both need root;
/// without, there are fewer kinds of faults. For the whole process: make it before any thread.
class Ground {
 public:
  /// `disk_size`: MB. The file system is mounted at `folder`, and TMPDIR points there.
  Ground(const std::filesystem::path& folder, int disk_size);
  [[nodiscard]] const Abilities& abilities() const { return abilities_; }

  /// Loses `share` of the packets of every socket that the process has, both ways. The port of
  /// discovery's multicast, which all share, is left alone on the way in.
  void lose_packets(pid_t pid, double share) const;
  void restore_network() const;
  void fill_disk() const;
  void free_disk() const;

 private:
  std::filesystem::path folder_;
  Abilities abilities_;
};

/// UDP ports at which the sockets of a process stand; from /proc.
[[nodiscard]] std::vector<int> udp_ports(pid_t pid);

}  // namespace coop::chaos
