#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/fields.hpp"

namespace coop::runtime {

/// How programs find and reach each other, and whether they let strangers in: section `dds` of a
/// launch file, `--dds KEY=VALUE` of a component, COOP_DDS in the environment. The defaults are
/// right for one host, and for several in one network that carries multicast (docs/hosts.md).
struct DdsSettings {
  std::string discovery = "simple";     ///< simple: multicast; peers: the hosts named; server
  std::vector<std::string> peers;       ///< other hosts, addresses or names
  int peer_participants = 20;           ///< programs a host that peers are looked for
  std::string server;                   ///< ADDRESS:PORT of the discovery server
  int lease = 0;                        ///< s until one not heard is given up; 0: 5, server 18
  std::string transport = "udp";        ///< shm: shared memory too, within one host
  std::vector<std::string> interfaces;  ///< names or addresses to keep to; none: all
  bool security = false;                ///< only programs with keys take part
  std::filesystem::path keys;           ///< folder that `coop keys` made

  void describe(config::Fields& fields);
  /// Throws config::Error: settings that do not go together.
  void validate() const;
  /// What deviates from the defaults, as `key=value` for `--dds`.
  [[nodiscard]] std::vector<std::string> assignments() const;
};

/// `assignments` (`key=value`) on top of `settings`. Throws config::Error that starts with
/// `origin`.
void apply_dds_settings(DdsSettings& settings, const std::vector<std::string>& assignments,
                        const std::string& origin);

/// The settings of the environment variable COOP_DDS (`key=value`, separated by blanks), then
/// `assignments`. Throws config::Error, one line.
[[nodiscard]] DdsSettings read_dds_settings(const std::vector<std::string>& assignments);

}  // namespace coop::runtime
