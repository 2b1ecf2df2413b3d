#include "system/network/garbage.hpp"

#include <netinet/in.h>
#include <netinet/ip.h>
#include <netinet/udp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace coop::test {
namespace {

constexpr std::size_t kEnough = 4000;
constexpr std::size_t kHeader = 20;  // of an RTPS message
constexpr std::array<std::uint8_t, 4> kMagic{'R', 'T', 'P', 'S'};
/// Where in the header the sender's name stands; this one begins as Fast DDS's do.
constexpr std::size_t kName = 8;
constexpr std::array<std::uint8_t, 12> kStranger{1, 15, 0xba, 0xdc, 0x0d, 0xe0, 0, 0, 0, 0, 0, 9};
/// Kinds of sub-messages there are: pad, acknack, heartbeat, gap, info, nack_frag, data, security.
constexpr std::array<std::uint8_t, 16> kKinds{0x01, 0x06, 0x07, 0x08, 0x09, 0x0c, 0x0d, 0x0e,
                                              0x0f, 0x12, 0x13, 0x15, 0x16, 0x30, 0x31, 0x33};

/// A sub-message that Fast DDS puts at the end of its packets.
constexpr std::uint8_t kStatistics = 0x80;
constexpr std::uint8_t kStatisticsSize = 56;

bool is_rtps(const Packet& packet) {
  return packet.size() > kHeader && std::equal(kMagic.begin(), kMagic.end(), packet.begin());
}

/// The payload of an IP packet with UDP in it, from or to one of the ports.
Packet payload_of(const std::uint8_t* data, std::size_t size,
                  const std::vector<std::uint16_t>& ports) {
  if (size < sizeof(iphdr)) return {};
  const std::size_t header = static_cast<std::size_t>(data[0] & 0x0fU) * 4U;
  if (size < header + sizeof(udphdr)) return {};
  udphdr udp{};
  std::memcpy(&udp, data + header, sizeof udp);
  const auto wanted = [&ports](std::uint16_t port) {
    return std::ranges::find(ports, ntohs(port)) != ports.end();
  };
  if (!wanted(udp.dest) && !wanted(udp.source)) return {};
  return {data + header + sizeof udp, data + size};
}

}  // namespace

std::vector<Packet> capture_rtps(const std::vector<std::uint16_t>& ports,
                                 std::chrono::milliseconds duration) {
  std::vector<Packet> packets;
  const int raw = socket(AF_INET, SOCK_RAW | SOCK_CLOEXEC, IPPROTO_UDP);
  if (raw < 0) return packets;
  const auto end = std::chrono::steady_clock::now() + duration;
  std::array<std::uint8_t, 65536> buffer{};
  while (std::chrono::steady_clock::now() < end && packets.size() < kEnough) {
    pollfd ready{raw, POLLIN, 0};
    if (poll(&ready, 1, 50) <= 0) continue;
    const ssize_t size = recv(raw, buffer.data(), buffer.size(), 0);
    if (size <= 0) continue;
    Packet packet = payload_of(buffer.data(), static_cast<std::size_t>(size), ports);
    if (is_rtps(packet)) packets.push_back(std::move(packet));
  }
  close(raw);
  return packets;
}

std::vector<Packet> deadly_packets() {
  Packet begin{'R', 'T', 'P', 'S', 2, 2, 1, 15};
  begin.resize(kHeader);
  Packet statistics = begin;
  statistics.insert(statistics.end(), {kStatistics, 1, kStatisticsSize, 0});
  statistics.resize(statistics.size() + kStatisticsSize + 4);  // and more behind it
  Packet fragment = begin;
  const Packet rest{0x16, 3, 36, 0,                    // DATA_FRAG with parameters
                    0,    0, 28, 0,                    // which are where they belong
                    0,    1, 0,  0xc7, 0, 1, 0, 0xc2,  // to those who hear announcements
                    0,    0, 0,  0,    1, 0, 0, 0,     // sequence number
                    1,    0, 0,  0,    1, 0, 1, 0,     // first fragment, count, size
                    1,    0, 0,  0,                    // size of the sample
                    1,    0, 0,  0};                   // the end of the parameters
  fragment.insert(fragment.end(), rest.begin(), rest.end());
  return {statistics, fragment};
}

Garbage::Garbage(std::vector<Packet> genuine, std::uint64_t seed, Sender sender)
    : genuine_(std::move(genuine)), random_(seed), sender_(sender) {}

std::size_t Garbage::below(std::size_t limit) {
  return limit == 0 ? 0 : static_cast<std::size_t>(random_() % limit);
}

Packet Garbage::noise(std::size_t longest) {
  Packet packet(below(longest + 1));
  for (auto& byte : packet) byte = static_cast<std::uint8_t>(random_());
  return packet;
}

Packet Garbage::mutated() {
  Packet packet = genuine_[below(genuine_.size())];
  for (std::size_t changes = below(4) + 1; changes > 0; --changes) {
    switch (below(6)) {
      case 0:  // cut short
        packet.resize(below(packet.size()) + 1);
        break;
      case 1:  // a bit
        packet[below(packet.size())] ^= static_cast<std::uint8_t>(1U << below(8));
        break;
      case 2: {  // an extreme number, where lengths and counts may stand
        const std::size_t at = below(packet.size());
        const auto value = static_cast<std::uint8_t>(below(2) == 0 ? 0x00 : 0xff);
        for (std::size_t i = at; i < std::min(at + 4, packet.size()); ++i) packet[i] = value;
        break;
      }
      case 3:  // another kind of sub-message, with flags and length as they were
        if (packet.size() > kHeader) packet[kHeader] = kKinds[below(kKinds.size())];
        break;
      case 4: {  // sub-messages of another packet behind these
        const Packet& other = genuine_[below(genuine_.size())];
        packet.insert(packet.end(), other.begin() + kHeader, other.end());
        if (packet.size() > 60000) packet.resize(60000);
        break;
      }
      default: {  // a piece of itself over another
        const std::size_t from = below(packet.size());
        const std::size_t to = below(packet.size());
        const std::size_t size = std::min(below(64), packet.size() - std::max(from, to));
        std::copy_n(Packet(packet).begin() + static_cast<long>(from), size,
                    packet.begin() + static_cast<long>(to));
      }
    }
  }
  return packet;
}

Packet Garbage::next() {
  const std::size_t choice = below(10);
  if (choice == 0) return noise(1500);
  if (choice == 1 || genuine_.empty()) {  // a proper header, then noise
    Packet packet = noise(1500);
    packet.resize(std::max(packet.size(), kHeader + 4));
    constexpr std::array<std::uint8_t, 8> kStart{'R', 'T', 'P', 'S', 2, 2, 1, 15};
    std::ranges::copy(kStart, packet.begin());
    packet[kHeader] = kKinds[below(kKinds.size())];
    return packet;
  }
  Packet packet = mutated();
  if (sender_ == Sender::kStranger) sign(packet);
  return packet;
}

void Garbage::sign(Packet& packet) const {
  if (packet.size() < kHeader) return;
  std::ranges::copy(kStranger, packet.begin() + kName);
}

Thrower::Thrower() : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  if (socket_ < 0) throw std::runtime_error("no socket");
}

Thrower::~Thrower() {
  close(socket_);
}

void Thrower::throw_at(std::uint16_t port, const Packet& packet) const {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  [[maybe_unused]] const auto sent =
      sendto(socket_, packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&to), sizeof to);
}

}  // namespace coop::test
