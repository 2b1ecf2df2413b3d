#include "runtime/packet_guard.hpp"

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <thread>
#include <vector>

namespace coop::runtime {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kBigEndian = 0;
constexpr std::uint8_t kLittleEndian = 1;
constexpr std::uint8_t kInfoTimestamp = 0x09;
constexpr std::uint8_t kData = 0x15;
constexpr std::uint8_t kDataFrag = 0x16;
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

/// Of a DATA_FRAG, little endian: from its entities on.
struct Fragment {
  std::uint32_t first = 1;
  std::uint16_t count = 1;
  std::uint16_t size = 8;
  std::uint32_t sample = 8;
  std::uint16_t to_inline_qos = 28;
  Bytes inline_qos = {};
  std::size_t payload = 8;
  std::uint32_t high_sequence = 0;
};

void put(Bytes& bytes, std::size_t at, std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i) {
    bytes[at + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

Bytes packet_of(const Fragment& fragment) {
  const std::size_t size = 32 + fragment.inline_qos.size() + fragment.payload;
  const auto flags = static_cast<std::uint8_t>(fragment.inline_qos.empty() ? 1 : 3);
  Bytes bytes = submessage(kDataFrag, static_cast<unsigned>(size), 32, flags);
  put(bytes, 4 + 2, fragment.to_inline_qos, 2);
  put(bytes, 4 + 12, fragment.high_sequence, 4);
  put(bytes, 4 + 16, 1, 4);
  put(bytes, 4 + 20, fragment.first, 4);
  put(bytes, 4 + 24, fragment.count, 2);
  put(bytes, 4 + 26, fragment.size, 2);
  put(bytes, 4 + 28, fragment.sample, 4);
  return message() + bytes + fragment.inline_qos + Bytes(fragment.payload);
}

const Bytes kNoParameters{1, 0, 0, 0};
const Bytes kKeyHash{0x70, 0, 4, 0, 9, 9, 9, 9, 1, 0, 0, 0};

TEST(PacketGuard, FragmentsThatSayWhatTheyHoldPass) {
  EXPECT_TRUE(is_harmless(packet_of({})));
  EXPECT_TRUE(is_harmless(packet_of({.inline_qos = kNoParameters})));
  EXPECT_TRUE(is_harmless(packet_of({.inline_qos = kKeyHash})));
  EXPECT_TRUE(is_harmless(packet_of({.first = 2, .count = 2, .sample = 30, .payload = 16})));
  // The last one is as long as what is left; one that is encrypted is longer.
  EXPECT_TRUE(is_harmless(packet_of({.first = 4, .sample = 30, .payload = 6})));
  EXPECT_TRUE(is_harmless(packet_of({.payload = 60})));
}

TEST(PacketGuard, AFragmentThatEndsBareFastDdsIsRefused) {
  // Parameters, and no payload behind them: Fast DDS frees what it did not allocate.
  EXPECT_FALSE(is_harmless(packet_of({.inline_qos = kNoParameters, .payload = 0})));
  EXPECT_FALSE(is_harmless(packet_of({.to_inline_qos = 400, .inline_qos = kNoParameters})));
}

TEST(PacketGuard, FragmentsThatDoNotLieWithinTheirSampleAreRefused) {
  EXPECT_FALSE(is_harmless(packet_of({.first = 0})));
  EXPECT_FALSE(is_harmless(packet_of({.first = 2})));
  EXPECT_FALSE(is_harmless(packet_of({.count = 0})));
  EXPECT_FALSE(is_harmless(packet_of({.count = 2, .payload = 16})));
  EXPECT_FALSE(is_harmless(packet_of({.size = 0})));
  EXPECT_FALSE(is_harmless(packet_of({.size = 1, .sample = 1})));
  EXPECT_FALSE(is_harmless(packet_of({.sample = 0})));
  EXPECT_FALSE(is_harmless(packet_of({.count = 0xffff, .size = 0xffff, .sample = 0xfffe0001})));
  EXPECT_FALSE(is_harmless(packet_of({.payload = 7})));
  EXPECT_FALSE(is_harmless(packet_of({.high_sequence = 0x100})));
}

/// A DATA with a place for everything, and flags.
Bytes packet_with_data(std::uint8_t flags, std::uint16_t to_inline_qos, const Bytes& rest) {
  Bytes bytes = submessage(kData, static_cast<unsigned>(20 + rest.size()), 20, flags);
  put(bytes, 4 + 2, to_inline_qos, 2);
  put(bytes, 4 + 16, 1, 4);
  return message() + bytes + rest;
}

TEST(PacketGuard, DataThatDoNotLieWithinTheirSubmessageAreRefused) {
  constexpr std::uint8_t kWithQos = 3;
  constexpr std::uint8_t kWithPayload = 5;
  constexpr std::uint8_t kWithBoth = 7;
  const Bytes payload(8);
  EXPECT_TRUE(is_harmless(packet_with_data(kWithPayload, 16, payload)));
  EXPECT_TRUE(is_harmless(packet_with_data(kWithQos, 16, kKeyHash)));
  EXPECT_TRUE(is_harmless(packet_with_data(kWithBoth, 16, kKeyHash + payload)));
  EXPECT_FALSE(is_harmless(packet_with_data(kWithBoth, 16, kKeyHash)));
  EXPECT_FALSE(is_harmless(packet_with_data(kWithPayload, 24, payload)));
  EXPECT_FALSE(is_harmless(packet_with_data(kWithPayload, 12, payload)));
  EXPECT_FALSE(is_harmless(packet_with_data(kWithPayload, 60000, payload)));
  // A parameter that reaches beyond, and a list without an end.
  EXPECT_FALSE(is_harmless(packet_with_data(kWithBoth, 16, Bytes{0x70, 0, 99, 0} + payload)));
  EXPECT_FALSE(is_harmless(packet_with_data(kWithQos, 16, Bytes{0x70, 0, 4, 0, 9, 9, 9, 9})));
}

constexpr std::uint8_t kAcknack = 0x06;
constexpr std::uint8_t kHeartbeat = 0x07;
constexpr std::uint8_t kGap = 0x08;

/// A sub-message of two entities and sequence numbers, given as pairs of high and low.
Bytes packet_of_numbers(std::uint8_t kind, const std::vector<std::uint32_t>& numbers,
                        std::size_t size) {
  Bytes bytes = submessage(kind, static_cast<unsigned>(size), size);
  for (std::size_t i = 0; i < numbers.size(); ++i) put(bytes, 4 + 8 + 4 * i, numbers[i], 4);
  return message() + bytes;
}

TEST(PacketGuard, SequenceNumbersNobodyCountsToAreRefused) {
  EXPECT_TRUE(is_harmless(packet_of_numbers(kHeartbeat, {0, 1, 0, 0}, 28)));
  EXPECT_TRUE(is_harmless(packet_of_numbers(kHeartbeat, {0xff, 1, 0xff, 0xffffffff}, 28)));
  EXPECT_FALSE(is_harmless(packet_of_numbers(kHeartbeat, {0, 1, 0x100, 0}, 28)));
  EXPECT_FALSE(is_harmless(packet_of_numbers(kHeartbeat, {0x7fffffff, 1, 0x7fffffff, 1}, 28)));
  EXPECT_FALSE(is_harmless(packet_of_numbers(kHeartbeat, {0, 1, 0, 1}, 24)));
  EXPECT_TRUE(is_harmless(packet_of_numbers(kAcknack, {0, 0, 0}, 24)));
  EXPECT_TRUE(is_harmless(packet_of_numbers(kAcknack, {0, 7, 256}, 24 + 32)));
  EXPECT_FALSE(is_harmless(packet_of_numbers(kAcknack, {0, 7, 256}, 24 + 28)));
  EXPECT_FALSE(is_harmless(packet_of_numbers(kAcknack, {0, 7, 257}, 24 + 64)));
  EXPECT_FALSE(is_harmless(packet_of_numbers(kAcknack, {0x100, 0, 0}, 24)));
}

TEST(PacketGuard, AGapThatWouldKeepFastDdsBusyForEverIsRefused) {
  EXPECT_TRUE(is_harmless(packet_of_numbers(kGap, {0, 1, 0, 2, 0}, 28)));
  EXPECT_TRUE(is_harmless(packet_of_numbers(kGap, {0, 1, 0, 1'000'000, 0}, 28)));
  EXPECT_FALSE(is_harmless(packet_of_numbers(kGap, {0, 1, 1, 0, 0}, 28)));
  EXPECT_FALSE(is_harmless(packet_of_numbers(kGap, {0, 0, 0, 2, 0}, 28)));
  EXPECT_FALSE(is_harmless(packet_of_numbers(kGap, {0x80000000, 0, 0, 2, 0}, 28)));
}

Bytes data_of(std::array<std::uint8_t, 4> writer, std::uint8_t kind = kData) {
  Bytes bytes = submessage(kind, 24, 24);
  std::ranges::copy(writer, bytes.begin() + 12);
  return bytes;
}

TEST(PacketGuard, AnnouncementsAndHandshakesIntroduceAndNothingElseDoes) {
  EXPECT_TRUE(introduces(message() + submessage(kInfoTimestamp, 8, 8) + data_of({0, 1, 0, 0xc2})));
  EXPECT_TRUE(introduces(message() + data_of({0, 0, 2, 3}) + data_of({0, 2, 1, 0xc3})));
  EXPECT_FALSE(introduces(message() + data_of({0, 0, 2, 3})));
  EXPECT_FALSE(introduces(message() + data_of({0, 1, 0, 0xc2}, kStatistics)));
  EXPECT_FALSE(introduces(message() + submessage(kData, 8, 8)));
  EXPECT_FALSE(introduces(message()));
}

/// A sub-message between two endpoints.
Bytes between(std::uint8_t kind, std::array<std::uint8_t, 4> reader,
              std::array<std::uint8_t, 4> writer) {
  Bytes bytes = submessage(kind, 28, 28);
  const std::ptrdiff_t at = kind == kData ? 8 : 4;
  std::ranges::copy(reader, bytes.begin() + at);
  std::ranges::copy(writer, bytes.begin() + at + 4);
  return bytes;
}

TEST(PacketGuard, WithKeysWhatIsAlwaysEncryptedIsNotTakenInTheClear) {
  EXPECT_TRUE(is_protected(message() + data_of({0, 1, 0, 0xc2}), false));
  EXPECT_TRUE(is_protected(message() + data_of({0, 2, 1, 0xc3}), false));
  EXPECT_TRUE(is_protected(message() + between(kHeartbeat, {0, 0, 2, 4}, {0, 0, 2, 3}), false));
  EXPECT_TRUE(is_protected(message() + between(kHeartbeat, {}, {0, 0, 3, 0xc2}), false));
  EXPECT_FALSE(is_protected(message() + data_of({0, 0, 3, 0xc2}), false));
  EXPECT_FALSE(is_protected(message() + data_of({0, 0, 4, 0xc2}), false));
  EXPECT_FALSE(is_protected(message() + data_of({0, 2, 0, 0xc2}), false));
  EXPECT_FALSE(is_protected(message() + data_of({0xff, 0, 3, 0xc2}), false));
  EXPECT_FALSE(
      is_protected(message() + between(kAcknack, {0xff, 2, 2, 0xc4}, {0xff, 2, 2, 0xc3}), false));
}

TEST(PacketGuard, WhereMessagesAreSignedOnlyIntroductionsAreTakenInTheClear) {
  constexpr std::uint8_t kSecurePrefix = 0x31;
  constexpr std::uint8_t kSecurePostfix = 0x32;
  constexpr std::uint8_t kSecureMessage = 0x33;
  EXPECT_TRUE(is_protected(message() + data_of({0, 1, 0, 0xc2}), true));
  EXPECT_TRUE(is_protected(message() + submessage(kSecureMessage, 24, 24), true));
  EXPECT_TRUE(is_protected(message() + submessage(kInfoTimestamp, 8, 8), true));
  // Keys are exchanged before messages can be signed.
  EXPECT_TRUE(is_protected(message() + submessage(kSecurePrefix, 24, 24) +
                               submessage(0x30, 24, 24) + submessage(kSecurePostfix, 24, 24),
                           true));
  EXPECT_FALSE(is_protected(message() + between(kHeartbeat, {0, 0, 2, 4}, {0, 0, 2, 3}), true));
  EXPECT_FALSE(is_protected(message() + data_of({0, 0, 2, 3}), true));
  EXPECT_FALSE(is_protected(message() + between(kAcknack, {0, 1, 0, 0xc7}, {0, 1, 0, 0xc2}), true));
}

using eprosima::fastdds::rtps::ChainingTransportDescriptor;
using eprosima::fastdds::rtps::TransportReceiverInterface;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;
using eprosima::fastrtps::rtps::Locator_t;
using eprosima::fastrtps::rtps::LocatorsIterator;
using eprosima::fastrtps::rtps::octet;
using eprosima::fastrtps::rtps::SenderResource;

/// Between Fast DDS and a socket, with both ends in the test's hands.
class GuardBetween : public ::testing::Test, private TransportReceiverInterface {
 protected:
  class Wire : public SenderResource {
   public:
    Wire() : SenderResource(LOCATOR_KIND_UDPv4) {
      send_lambda_ = [this](const octet*, std::uint32_t, LocatorsIterator*, LocatorsIterator*,
                            const std::chrono::steady_clock::time_point&) {
        ++sent;
        return true;
      };
    }
    int sent = 0;
  };

  int sent(const Bytes& packet) {
    Wire wire;
    EXPECT_TRUE(guard_->send(&wire, packet.data(), static_cast<std::uint32_t>(packet.size()),
                             nullptr, nullptr, std::chrono::steady_clock::now()));
    return wire.sent;
  }
  void receive(const Bytes& packet) {
    guard_->receive(this, packet.data(), static_cast<std::uint32_t>(packet.size()), {}, {});
  }
  void OnDataReceived(const octet*, const std::uint32_t, const Locator_t&,
                      const Locator_t&) override {
    const int now = ++inside_;
    most_inside_ = std::max(most_inside_.load(), now);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));  // the handling, not a wait
    --inside_;
  }

  std::shared_ptr<Introductions> introductions_ = std::make_shared<Introductions>();
  std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> descriptor_ =
      guarded(std::make_shared<UDPv4TransportDescriptor>(), introductions_);
  std::unique_ptr<eprosima::fastdds::rtps::ChainingTransport> guard_{
      dynamic_cast<eprosima::fastdds::rtps::ChainingTransport*>(descriptor_->create_transport())};
  std::atomic<int> inside_ = 0;
  std::atomic<int> most_inside_ = 0;
};

TEST_F(GuardBetween, AParticipantIsNotAnnouncedBeforeItMayBe) {
  const Bytes announcement = message() + data_of({0, 1, 0, 0xc2});
  const Bytes other = message() + data_of({0, 0, 2, 3});
  EXPECT_EQ(sent(announcement), 0);
  EXPECT_EQ(sent(other), 1);
  introductions_->may_announce = true;
  EXPECT_EQ(sent(announcement), 1);
}

TEST_F(GuardBetween, ThoseWhoIntroduceAreHandledOneAtATimeAndAllOthersAreNotHeldUp) {
  const auto from_two_threads = [this](const Bytes& packet) {
    most_inside_ = 0;
    const auto many = [&] {
      for (int i = 0; i < 20; ++i) receive(packet);
    };
    std::thread other(many);
    many();
    other.join();
    return most_inside_.load();
  };
  EXPECT_EQ(from_two_threads(message() + data_of({0, 1, 0, 0xc2})), 1);
  EXPECT_EQ(from_two_threads(message() + data_of({0, 0, 2, 3})), 2);
}

}  // namespace
}  // namespace coop::runtime
