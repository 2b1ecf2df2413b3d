#pragma once
#include <string>

namespace coop::runtime {

/// The IPv4 address of an interface of this host, named ("eth0") or by its address itself. Throws
/// config::Error that lists those there are.
[[nodiscard]] std::string interface_address(const std::string& interface);

/// The IPv4 address of a host, given as such or as a name. Throws config::Error that starts with
/// `key` where it does not resolve.
[[nodiscard]] std::string host_address(const std::string& host, const std::string& key);

}  // namespace coop::runtime
