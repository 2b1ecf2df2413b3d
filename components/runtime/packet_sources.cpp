#include "runtime/packet_sources.hpp"

#include <ifaddrs.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>

namespace coop::runtime {
namespace {

/// Of Coop, in the range that is left to vendors.
constexpr std::uint8_t kSourcePorts = 0xc0;
constexpr std::array<std::uint8_t, 4> kMark{'C', 'o', 'o', 'p'};
constexpr std::size_t kMostPorts = 256;
constexpr std::size_t kMostKnown = 512;
/// Announcements come at least every few seconds.
constexpr std::chrono::seconds kForgotten{60};
constexpr std::chrono::seconds kAddressesAge{1};
/// Tell of participants, their writers and their readers. Fast DDS does not ask whether these are
/// the teller's own.
constexpr std::array<wire::EntityId, 3> kTellers{
    wire::EntityId{0, 1, 0, 0xc2}, wire::EntityId{0, 0, 3, 0xc2}, wire::EntityId{0, 0, 4, 0xc2}};

bool tells_of_somebody(const wire::Submessage& submessage) {
  if (submessage.kind != wire::kData && submessage.kind != wire::kDataFrag) return false;
  const auto writer = submessage.writer();
  return writer && std::ranges::find(kTellers, *writer) != kTellers.end();
}

bool is_loopback(std::uint32_t address) {
  return address >> 24U == 127;
}

/// The port a socket of ours is at, where it is one of IPv4 and UDP.
std::optional<std::uint16_t> udp_port(int socket) {
  int type = 0;
  socklen_t size = sizeof type;
  if (getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) {
    return std::nullopt;
  }
  sockaddr_in name{};
  size = sizeof name;
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&name), &size) != 0) return std::nullopt;
  if (name.sin_family != AF_INET || name.sin_port == 0) return std::nullopt;
  return ntohs(name.sin_port);
}

/// What the first sub-message tells.
std::vector<std::uint16_t> told_ports(wire::Bytes packet) {
  wire::Bytes rest = packet.subspan(wire::kHeader);
  std::vector<std::uint16_t> ports;
  if (rest.empty() || rest[0] != kSourcePorts) return ports;
  const auto told = wire::take_submessage(rest);
  if (!told || told->body.size() < kMark.size()) return ports;
  if (!std::ranges::equal(told->body.first(kMark.size()), kMark)) return ports;
  for (std::size_t at = kMark.size(); at + 2 <= told->body.size(); at += 2) {
    ports.push_back(told->u16(at));
  }
  return ports;
}

std::vector<std::uint32_t> own_addresses() {
  std::vector<std::uint32_t> addresses;
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return addresses;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in name{};
    std::memcpy(&name, one->ifa_addr, sizeof name);
    addresses.push_back(ntohl(name.sin_addr.s_addr));
  }
  freeifaddrs(all);
  return addresses;
}

}  // namespace

std::vector<std::uint16_t> own_udp_ports() {
  std::vector<std::uint16_t> ports;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const std::string name = entry.path().filename();
    int number = 0;
    if (std::from_chars(name.data(), name.data() + name.size(), number).ec != std::errc()) continue;
    if (const auto port = udp_port(number)) ports.push_back(*port);
  }
  std::ranges::sort(ports);
  const auto same = std::ranges::unique(ports);
  ports.erase(same.begin(), same.end());
  return ports;
}

std::vector<std::uint8_t> with_source_ports(wire::Bytes packet,
                                            const std::vector<std::uint16_t>& ports) {
  std::size_t count = std::min(ports.size(), kMostPorts);
  count += count % 2;
  const std::size_t size = kMark.size() + 2 * count;  // a multiple of four
  std::vector<std::uint8_t> out;
  out.reserve(packet.size() + 4 + size);
  const auto append = [&out](auto begin, auto end) { out.insert(out.end(), begin, end); };
  const auto append_number = [&out](std::size_t number) {
    out.push_back(static_cast<std::uint8_t>(number & 0xffU));
    out.push_back(static_cast<std::uint8_t>(number >> 8U));
  };
  append(packet.begin(), packet.begin() + wire::kHeader);
  out.insert(out.end(), {kSourcePorts, 1});  // little endian
  append_number(size);
  append(kMark.begin(), kMark.end());
  for (std::size_t i = 0; i < count; ++i) append_number(ports[std::min(i, ports.size() - 1)]);
  append(packet.begin() + wire::kHeader, packet.end());
  return out;
}

std::size_t PacketSources::Hash::operator()(const wire::Prefix& prefix) const noexcept {
  std::uint64_t first = 0;
  std::uint32_t second = 0;
  std::memcpy(&first, prefix.data(), sizeof first);
  std::memcpy(&second, prefix.data() + sizeof first, sizeof second);
  return static_cast<std::size_t>((first ^ second) * 0x9e3779b97f4a7c15U);
}

bool PacketSources::may_be_genuine(wire::Bytes packet, PacketSource from) {
  const wire::Prefix name = wire::sender(packet);
  if (!may_be(name, from)) return false;
  for (auto rest = packet.subspan(wire::kHeader); !rest.empty();) {
    const auto next = wire::take_submessage(rest);
    if (!next) return false;
    if (next->kind == wire::kInfoSource && next->body.size() >= 8 + name.size()) {
      wire::Prefix other;
      std::ranges::copy(next->body.subspan(8, other.size()), other.begin());
      if (!may_be(other, from)) return false;
    }
    if (!tells_of_somebody(*next)) continue;
    for (const wire::Prefix& other : wire::told_of(*next)) {
      if (other != name && !may_be(other, from)) return false;
    }
  }
  // Ports that are not told from one of them say nothing: an old packet, or changed on its way.
  auto ports = told_ports(packet);
  if (std::ranges::find(ports, from.port) != ports.end()) learn(name, std::move(ports), from);
  return true;
}

void PacketSources::add_own(const wire::Prefix& name, const std::vector<std::uint16_t>& ports) {
  learn(name, ports, {INADDR_LOOPBACK, ports.empty() ? std::uint16_t{0} : ports.front()});
}

bool PacketSources::may_be(const wire::Prefix& name, PacketSource from) {
  bool is_here = false;
  {
    const std::shared_lock lock(mutex_);
    const auto found = known_.find(name);
    if (found == known_.end()) return true;
    const Known& known = found->second;
    if (std::ranges::find(known.ports, from.port) == known.ports.end()) return false;
    is_here = known.is_here;
  }
  return !is_here || is_own_address(from.address);
}

bool PacketSources::is_own_address(std::uint32_t address) {
  if (is_loopback(address)) return true;
  const std::scoped_lock lock(addresses_mutex_);
  if (std::ranges::find(addresses_, address) != addresses_.end()) return true;
  if (Wall::now() - addresses_read_ < kAddressesAge) return false;
  addresses_ = own_addresses();
  addresses_read_ = Wall::now();
  return std::ranges::find(addresses_, address) != addresses_.end();
}

void PacketSources::learn(const wire::Prefix& name, std::vector<std::uint16_t> ports,
                          PacketSource from) {
  const std::unique_lock lock(mutex_);
  const auto now = Wall::now();
  if (known_.size() >= kMostKnown && !known_.contains(name)) {
    std::erase_if(known_, [now](const auto& one) { return now - one.second.told > kForgotten; });
    if (known_.size() >= kMostKnown) return;
  }
  Known& known = known_[name];
  known.ports = std::move(ports);
  known.is_here = known.is_here || is_loopback(from.address);
  known.told = now;
}

}  // namespace coop::runtime
