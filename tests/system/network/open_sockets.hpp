#pragma once
#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace coop::test {

/// A socket of a process through which something can come in.
struct OpenSocket {
  std::string kind;  ///< udp, udp6, tcp, tcp6, raw, unix
  std::string name;  ///< unix: its path or @name; empty: it has none
  std::uint16_t port = 0;
};

/// UDP sockets that are bound, TCP sockets that listen, Unix sockets that listen, and raw ones.
[[nodiscard]] std::vector<OpenSocket> open_sockets(pid_t pid);

}  // namespace coop::test
