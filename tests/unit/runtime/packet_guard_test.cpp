#include "runtime/packet_guard.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace coop::runtime {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kBigEndian = 0;
constexpr std::uint8_t kLittleEndian = 1;
constexpr std::uint8_t kInfoTimestamp = 0x09;
constexpr std::uint8_t kData = 0x15;
constexpr std::uint8_t kStatistics = 0x80;

Bytes message() {
  Bytes bytes{'R', 'T', 'P', 'S', 2, 2, 1, 15};
  bytes.resize(20);
  return bytes;
}

Bytes operator+(Bytes bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
  return bytes;
}

/// `told`: the length in its header; `size`: what follows that.
Bytes submessage(std::uint8_t kind, unsigned told, std::size_t size,
                 std::uint8_t flags = kLittleEndian) {
  const auto low = static_cast<std::uint8_t>(told & 0xffU);
  const auto high = static_cast<std::uint8_t>(told >> 8U);
  Bytes bytes = flags == kBigEndian ? Bytes{kind, flags, high, low} : Bytes{kind, flags, low, high};
  bytes.resize(bytes.size() + size);
  return bytes;
}

TEST(PacketGuard, MessagesOfWholeSubmessagesPass) {
  EXPECT_TRUE(is_harmless(message()));
  EXPECT_TRUE(is_harmless(message() + submessage(kData, 300, 300)));
  EXPECT_TRUE(is_harmless(message() + submessage(kData, 300, 300, kBigEndian)));
  EXPECT_TRUE(is_harmless(message() + submessage(kInfoTimestamp, 8, 8) + submessage(kData, 24, 24) +
                          submessage(kStatistics, 56, 56)));
}

TEST(PacketGuard, ALengthOfNothingReachesToTheEndButForThoseThatMayBeEmpty) {
  EXPECT_TRUE(is_harmless(message() + submessage(kData, 0, 70000)));
  EXPECT_TRUE(is_harmless(message() + submessage(kInfoTimestamp, 0, 0) + submessage(kData, 8, 8)));
  // What follows the empty one is read as a sub-message, and is too short for one.
  EXPECT_FALSE(is_harmless(message() + submessage(kInfoTimestamp, 0, 3)));
}

TEST(PacketGuard, StatisticsThatAreNotTheLastAreRefused) {
  EXPECT_FALSE(is_harmless(message() + submessage(kStatistics, 56, 60)));
  EXPECT_FALSE(
      is_harmless(message() + submessage(kStatistics, 56, 56) + submessage(kData, 24, 24)));
  EXPECT_FALSE(is_harmless(message() + submessage(kStatistics, 56, 60, kBigEndian)));
  // Lengths are rounded up to four before the next is looked for.
  EXPECT_FALSE(is_harmless(message() + submessage(kData, 5, 8) + submessage(kStatistics, 56, 60)));
  EXPECT_TRUE(is_harmless(message() + submessage(kStatistics, 0, 56)));
}

TEST(PacketGuard, WhatIsNoMessageOrReachesBeyondThePacketIsRefused) {
  EXPECT_FALSE(is_harmless({}));
  const Bytes whole = message();
  EXPECT_FALSE(is_harmless(std::span(whole).first(19)));
  Bytes other = message();
  other[0] = 'X';
  EXPECT_FALSE(is_harmless(other));
  EXPECT_FALSE(is_harmless(message() + submessage(kData, 25, 24)));
  EXPECT_FALSE(is_harmless(message() + Bytes{kData, kLittleEndian, 0}));
}

TEST(PacketGuard, NoMessageCutAnywhereHidesStatistics) {
  const Bytes whole =
      message() + submessage(kInfoTimestamp, 8, 8) + submessage(kStatistics, 56, 60);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const bool holds_none = size == 20 || size == 20 + 12;
    const bool ends_with_them = size == 20 + 12 + 4 + 56;
    EXPECT_EQ(is_harmless(std::span(whole).first(size)), holds_none || ends_with_them) << size;
  }
}

}  // namespace
}  // namespace coop::runtime
