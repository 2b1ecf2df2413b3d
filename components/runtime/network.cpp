#include "runtime/network.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netdb.h>

#include <memory>

#include "core/config/error.hpp"

namespace coop::runtime {
namespace {

std::string to_text(const sockaddr& address) {
  char text[INET_ADDRSTRLEN] = "";
  const auto& internet = reinterpret_cast<const sockaddr_in&>(address);
  inet_ntop(AF_INET, &internet.sin_addr, text, sizeof text);
  return text;
}

}  // namespace

std::string interface_address(const std::string& interface) {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) throw config::Error("dds.interfaces: cannot list them");
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(first, &freeifaddrs);
  std::string known;
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    std::string address = to_text(*entry->ifa_addr);
    if (interface == entry->ifa_name || interface == address) return address;
    known += (known.empty() ? "" : ", ") + std::string(entry->ifa_name) + " " + address;
  }
  throw config::Error("dds.interfaces: no interface '" + interface + "' here; there are: " + known);
}

std::string host_address(const std::string& host, const std::string& key) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* first = nullptr;
  const int problem = getaddrinfo(host.c_str(), nullptr, &wanted, &first);
  if (problem != 0 || first == nullptr) {
    throw config::Error(key + ": no address of '" + host + "': " + gai_strerror(problem));
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> all(first, &freeaddrinfo);
  return to_text(*first->ai_addr);
}

}  // namespace coop::runtime
