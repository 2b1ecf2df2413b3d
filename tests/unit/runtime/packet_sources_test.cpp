#include "runtime/packet_sources.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <vector>

namespace coop::runtime {
namespace {

using Packet = std::vector<std::uint8_t>;
using ::testing::Contains;
using ::testing::Not;

constexpr wire::Prefix kLaser{1, 15, 7, 7, 1, 2, 3, 4, 0, 0, 0, 0};
constexpr wire::Prefix kStranger{1, 15, 9, 9, 1, 2, 3, 4, 0, 0, 0, 0};
constexpr std::uint32_t kHere = 0x7f000001;
constexpr std::uint32_t kElsewhere = 0xc0000209;  // 192.0.2.9

Packet packet_of(const wire::Prefix& name) {
  Packet packet{'R', 'T', 'P', 'S', 2, 2, 1, 15};
  packet.insert(packet.end(), name.begin(), name.end());
  packet.insert(packet.end(), {wire::kInfoTimestamp, 3, 0, 0});
  return packet;
}

Packet announcement_of(const wire::Prefix& name, const std::vector<std::uint16_t>& ports) {
  return with_source_ports(packet_of(name), ports);
}

TEST(PacketSources, WhoDoesNotTellItsPortsIsBelievedFromAll) {
  PacketSources sources;
  EXPECT_TRUE(sources.may_be_genuine(packet_of(kLaser), {kHere, 1000}));
  EXPECT_TRUE(sources.may_be_genuine(packet_of(kLaser), {kElsewhere, 2000}));
}

TEST(PacketSources, WhoTellsItsPortsIsBelievedFromThoseAlone) {
  PacketSources sources;
  EXPECT_TRUE(sources.may_be_genuine(announcement_of(kLaser, {1000, 1001}), {kElsewhere, 1000}));
  EXPECT_TRUE(sources.may_be_genuine(packet_of(kLaser), {kElsewhere, 1000}));
  EXPECT_TRUE(sources.may_be_genuine(packet_of(kLaser), {kElsewhere, 1001}));
  EXPECT_FALSE(sources.may_be_genuine(packet_of(kLaser), {kElsewhere, 2000}));
  EXPECT_TRUE(sources.may_be_genuine(packet_of(kStranger), {kElsewhere, 2000}));
}

TEST(PacketSources, OneWithSeveralAddressesIsBelievedFromAllOfThem) {
  PacketSources sources;
  EXPECT_TRUE(sources.may_be_genuine(announcement_of(kLaser, {1000}), {kElsewhere, 1000}));
  EXPECT_TRUE(sources.may_be_genuine(packet_of(kLaser), {kElsewhere + 1, 1000}));
}

TEST(PacketSources, WhoIsHeardByLoopbackIsOfThisMachine) {
  PacketSources sources;
  EXPECT_TRUE(sources.may_be_genuine(announcement_of(kLaser, {1000}), {kHere, 1000}));
  EXPECT_TRUE(sources.may_be_genuine(packet_of(kLaser), {kHere + 1, 1000}));
  EXPECT_FALSE(sources.may_be_genuine(packet_of(kLaser), {kElsewhere, 1000}));
}

TEST(PacketSources, AnAnnouncementThatIsRepeatedByAnotherTellsNothing) {
  PacketSources sources;
  EXPECT_TRUE(sources.may_be_genuine(announcement_of(kLaser, {1000}), {kHere, 2000}));
  EXPECT_TRUE(sources.may_be_genuine(announcement_of(kLaser, {1000}), {kHere, 1000}));
  EXPECT_FALSE(sources.may_be_genuine(announcement_of(kLaser, {1000}), {kHere, 2000}));
}

TEST(PacketSources, WhoIsKnownTellsOfFurtherPortsFromItsOwnAlone) {
  PacketSources sources;
  EXPECT_TRUE(sources.may_be_genuine(announcement_of(kLaser, {1000}), {kHere, 1000}));
  EXPECT_FALSE(sources.may_be_genuine(announcement_of(kLaser, {1000, 2000}), {kHere, 2000}));
  EXPECT_FALSE(sources.may_be_genuine(packet_of(kLaser), {kHere, 2000}));
  EXPECT_TRUE(sources.may_be_genuine(announcement_of(kLaser, {1000, 2000}), {kHere, 1000}));
  EXPECT_TRUE(sources.may_be_genuine(packet_of(kLaser), {kHere, 2000}));
}

TEST(PacketSources, AStrangerDoesNotSpeakForOneWhoToldItsPorts) {
  PacketSources sources;
  EXPECT_TRUE(sources.may_be_genuine(announcement_of(kLaser, {1000}), {kHere, 1000}));
  Packet packet = packet_of(kStranger);
  packet.insert(packet.end(), {wire::kInfoSource, 1, 20, 0, 0, 0, 0, 0, 2, 2, 1, 15});
  packet.insert(packet.end(), kLaser.begin(), kLaser.end());
  EXPECT_FALSE(sources.may_be_genuine(packet, {kHere, 2000}));
  EXPECT_TRUE(sources.may_be_genuine(packet, {kHere, 1000}));
}

TEST(PacketSources, AStrangerDoesNotTellOfOneWhoToldItsPorts) {
  PacketSources sources;
  EXPECT_TRUE(sources.may_be_genuine(announcement_of(kLaser, {1000}), {kHere, 1000}));
  const auto telling = [](std::uint8_t writer, std::uint8_t parameter, bool in_payload) {
    Packet packet = packet_of(kStranger);
    const std::uint8_t flags = in_payload ? 5 : 3;
    const std::uint8_t size = in_payload ? 48 : 44;
    packet.insert(packet.end(), {wire::kData, flags, size, 0, 0, 0, 16, 0, 0, 0, 0, 0});
    packet.insert(packet.end(), {0, writer, 0, 0xc2, 0, 0, 0, 0, 1, 0, 0, 0});
    if (in_payload) packet.insert(packet.end(), {0, 3, 0, 0});
    packet.insert(packet.end(), {parameter, 0, 16, 0});
    packet.insert(packet.end(), kLaser.begin(), kLaser.end());
    packet.insert(packet.end(), {0, 0, 1, 0xc1, 1, 0, 0, 0});
    return packet;
  };
  constexpr std::uint8_t kHash = 0x70;
  constexpr std::uint8_t kParticipant = 0x50;
  EXPECT_FALSE(sources.may_be_genuine(telling(1, kParticipant, true), {kHere, 2000}));
  EXPECT_FALSE(sources.may_be_genuine(telling(1, kHash, false), {kHere, 2000}));
  EXPECT_TRUE(sources.may_be_genuine(telling(1, kParticipant, true), {kHere, 1000}));
  EXPECT_TRUE(sources.may_be_genuine(telling(9, kParticipant, true), {kHere, 2000}))
      << "of what is no discovery";
  // Fast DDS names another participant of the same process where it says what it answers.
  EXPECT_TRUE(sources.may_be_genuine(telling(1, 0x0f, false), {kHere, 2000}));
}

TEST(PacketSources, NobodySpeaksInOnesOwnName) {
  PacketSources sources;
  sources.add_own(kLaser, {1000, 1001});
  EXPECT_TRUE(sources.may_be_genuine(packet_of(kLaser), {kHere, 1001}));
  EXPECT_FALSE(sources.may_be_genuine(packet_of(kLaser), {kHere, 2000}));
  EXPECT_FALSE(sources.may_be_genuine(packet_of(kLaser), {kElsewhere, 1001}));
}

TEST(PacketSources, ManyNamesDoNotDriveOutThoseThatAreHeard) {
  PacketSources sources;
  EXPECT_TRUE(sources.may_be_genuine(announcement_of(kLaser, {1000}), {kHere, 1000}));
  for (unsigned i = 0; i < 5000; ++i) {
    wire::Prefix name = kStranger;
    name[4] = static_cast<std::uint8_t>(i & 0xffU);
    name[5] = static_cast<std::uint8_t>(i >> 8U);
    EXPECT_TRUE(sources.may_be_genuine(announcement_of(name, {2000}), {kElsewhere, 2000}));
  }
  EXPECT_FALSE(sources.may_be_genuine(packet_of(kLaser), {kHere, 2000}));
}

TEST(PacketSources, WhatTellsThePortsIsASubmessageOthersSkip) {
  const Packet plain = packet_of(kLaser);
  const Packet told = announcement_of(kLaser, {1000, 1001, 1002});
  wire::Bytes rest = wire::Bytes(told).subspan(wire::kHeader);
  const auto first = wire::take_submessage(rest);
  ASSERT_TRUE(first);
  EXPECT_GE(first->kind, 0x81);  // a vendor's, and not Fast DDS's statistics
  EXPECT_EQ(first->body.size() % 4, 0U);
  EXPECT_TRUE(std::ranges::equal(rest, wire::Bytes(plain).subspan(wire::kHeader)));
}

TEST(PacketSources, PortsOfThisProcessAreThoseOfItsUdpSockets) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ASSERT_GE(socket, 0);
  sockaddr_in name{};
  name.sin_family = AF_INET;
  ASSERT_EQ(bind(socket, reinterpret_cast<sockaddr*>(&name), sizeof name), 0);
  socklen_t size = sizeof name;
  ASSERT_EQ(getsockname(socket, reinterpret_cast<sockaddr*>(&name), &size), 0);
  EXPECT_THAT(own_udp_ports(), Contains(ntohs(name.sin_port)));
  close(socket);
  EXPECT_THAT(own_udp_ports(), Not(Contains(ntohs(name.sin_port))));
}

}  // namespace
}  // namespace coop::runtime
