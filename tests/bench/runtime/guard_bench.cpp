// What the guard in front of the transport costs a packet, beside what the kernel takes for it.
//   guard_bench --benchmark_out=FILE --benchmark_out_format=json
#include <benchmark/benchmark.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <vector>

#include "runtime/packet_guard.hpp"
#include "runtime/packet_sources.hpp"

namespace {

using namespace coop::runtime;
using eprosima::fastdds::rtps::ChainingTransport;
using eprosima::fastdds::rtps::TransportReceiverInterface;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;
using eprosima::fastrtps::rtps::Locator_t;
using Packet = std::vector<std::uint8_t>;

constexpr std::uint16_t kPort = 40000;
constexpr std::uint8_t kSenders = 12;  // a robot's
constexpr std::size_t kScan = 1480;

void append(Packet& packet, const Packet& more) {
  packet.insert(packet.end(), more.begin(), more.end());
}

/// A scan as Fast DDS sends it: time, data, heartbeat, statistics.
Packet scan_of(std::uint8_t sender) {
  Packet packet{'R', 'T', 'P', 'S', 2, 2, 1, 15, 1, 15, 7, 7, 1, 2, 3, sender, 0, 0, 0, 0};
  append(packet, {wire::kInfoTimestamp, 1, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  append(packet, {wire::kData, 5, (20 + kScan) & 0xffU, (20 + kScan) >> 8U, 0, 0, 16, 0});
  append(packet, {0, 0, 2, 4, 0, 0, 2, 3, 0, 0, 0, 0, 9, 0, 0, 0});
  packet.resize(packet.size() + kScan);
  append(packet, {wire::kHeartbeat, 1, 28, 0, 0, 0, 2, 4, 0, 0, 2, 3, 0, 0, 0, 0});
  append(packet, {9, 0, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0, 1, 0, 0, 0});
  append(packet, {wire::kStatistics, 1, 56, 0});
  packet.resize(packet.size() + 56);
  return packet;
}

class Receiver : public TransportReceiverInterface {
 public:
  void OnDataReceived(const unsigned char*, const std::uint32_t, const Locator_t&,
                      const Locator_t&) override {
    ++heard;
  }
  std::size_t heard = 0;
};

/// Argument: with security.
void guard(benchmark::State& state) {
  const auto introductions = state.range(0) != 0 ? std::make_shared<Introductions>() : nullptr;
  const auto descriptor = guarded(std::make_shared<UDPv4TransportDescriptor>(), introductions);
  const std::unique_ptr<ChainingTransport> guarded_transport(
      dynamic_cast<ChainingTransport*>(descriptor->create_transport()));
  Receiver receiver;
  Locator_t here(LOCATOR_KIND_UDPv4, kPort);
  here.address[12] = 127;
  here.address[15] = 1;
  const auto receive = [&](const Packet& packet) {
    guarded_transport->receive(&receiver, packet.data(), static_cast<std::uint32_t>(packet.size()),
                               here, here);
  };
  std::vector<Packet> packets;
  for (std::uint8_t i = 0; i < kSenders; ++i) {
    packets.push_back(scan_of(i));
    receive(with_source_ports(packets.back(), {kPort}));
  }
  receiver.heard = 0;
  std::size_t sent = 0;
  for ([[maybe_unused]] auto _ : state) receive(packets[sent++ % packets.size()]);
  if (receiver.heard != sent) state.SkipWithError("genuine packets were dropped");
}
BENCHMARK(guard)->Arg(0)->Arg(1);

/// The same packet from one socket to another by the loopback interface.
void kernel(benchmark::State& state) {
  const int from = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const int to = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof name;
  auto* address = reinterpret_cast<sockaddr*>(&name);
  if (bind(to, address, size) != 0 || getsockname(to, address, &size) != 0) {
    state.SkipWithError("no socket");
  }
  const Packet packet = scan_of(1);
  Packet buffer(65536);
  for ([[maybe_unused]] auto _ : state) {
    if (sendto(from, packet.data(), packet.size(), 0, address, size) < 0 ||
        recv(to, buffer.data(), buffer.size(), 0) < 0) {
      state.SkipWithError("nothing arrives");
      break;
    }
  }
  close(from);
  close(to);
}
BENCHMARK(kernel);

}  // namespace

BENCHMARK_MAIN();
