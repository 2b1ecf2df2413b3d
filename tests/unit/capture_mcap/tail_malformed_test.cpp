/// Whatever is done to a tail: what the capture itself holds is read as if there were none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "capture/mcap/recover.hpp"
#include "support/temporary_folder.hpp"
#include "unit/capture_mcap/capture.hpp"

namespace coop::mcap {
namespace {

using test::bytes_of;
using test::SmallFile;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::size_t kSlot = 2000;
constexpr std::uint64_t kMost = 64U << 10U;

/// A capture with a chunk, without its end, and a tail with two more.
class TailMalformedTest : public ::testing::Test {
 protected:
  TailMalformedTest() {
    SmallFile file;
    file.message(1, 0, "in the capture").end_chunk();
    capture_ = file.bytes();
    const coop::test::TemporaryFolder folder;
    Tail tail(folder.path() / "tail");
    std::vector<std::unique_ptr<ChunkBuilder>> chunks;
    for (Nanoseconds i = 1; i <= 2; ++i) {
      chunks.push_back(std::make_unique<ChunkBuilder>(Padding::kNone, tail.add_slot(kSlot)));
      chunks.back()->reserve(kSlot);
      chunks.back()->add(Message{1, 0, i, i, bytes_of("in the tail")});
    }
    tail_ = test::content_of(*open_plain_file(folder.path() / "tail"));
  }
  static std::size_t messages_of(const std::vector<std::byte>& capture,
                                 const std::vector<std::byte>& tail) {
    const auto both = with_tail(open_memory(capture), chunks_of_tail(*open_memory(tail), kMost));
    std::vector<std::byte> out;
    const RecoverReport report = recover(both, write_to_memory(out));
    Reader recovered(open_memory(std::move(out)));
    EXPECT_TRUE(recovered.summary().complete);
    EXPECT_THAT(test::lines_of(recovered), SizeIs(report.messages));
    return report.messages;
  }
  /// With a number of the head of a slot set to something else.
  [[nodiscard]] std::vector<std::byte> with_number(std::size_t slot, std::size_t index,
                                                   std::uint64_t value) const {
    auto bytes = tail_;
    const std::size_t at = slot * Tail::slot_size(kSlot) + 8 * index;
    for (std::size_t i = 0; i < 8; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
    return bytes;
  }

  std::vector<std::byte> capture_;
  std::vector<std::byte> tail_;
};

TEST_F(TailMalformedTest, WholeItAddsWhatTheCaptureLacks) {
  EXPECT_EQ(messages_of(capture_, tail_), 3U);
  EXPECT_EQ(messages_of(capture_, {}), 1U);
}

TEST_F(TailMalformedTest, NoNumberInAHeadIsBelievedBeyondTheFile) {
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  for (const std::uint64_t value :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{8}, std::uint64_t{kSlot - 1},
        std::uint64_t{kSlot + 1}, std::uint64_t{Tail::kHead}, kAll >> 1U, kAll - 4096, kAll}) {
    for (std::size_t slot = 0; slot < 2; ++slot) {
      for (std::size_t index = 0; index < 4; ++index) {
        const std::size_t messages = messages_of(capture_, with_number(slot, index, value));
        EXPECT_GE(messages, 1U + slot) << slot << ' ' << index << ' ' << value;
        EXPECT_LE(messages, 3U) << slot << ' ' << index << ' ' << value;
      }
    }
  }
}

TEST_F(TailMalformedTest, WhatItMayTakeOfMemoryIsBounded) {
  const auto tail = open_memory(tail_);
  const std::size_t one = chunks_of_tail(*tail).at(0).records.size();
  EXPECT_THAT(chunks_of_tail(*tail, 2 * one), SizeIs(2));
  EXPECT_THAT(chunks_of_tail(*tail, 2 * one - 1), SizeIs(1));
  EXPECT_THAT(chunks_of_tail(*tail, one - 1), IsEmpty());
}

TEST_F(TailMalformedTest, CutAnywhereItHasTheSlotsBefore) {
  for (std::size_t length = 0; length < tail_.size(); length += 37) {
    const std::vector<std::byte> cut(tail_.begin(),
                                     tail_.begin() + static_cast<std::ptrdiff_t>(length));
    const std::size_t messages = messages_of(capture_, cut);
    EXPECT_EQ(messages, length < Tail::kHead + kSlot                            ? 1U
                        : length < Tail::slot_size(kSlot) + Tail::kHead + kSlot ? 2U
                                                                                : 3U)
        << length;
  }
}

TEST_F(TailMalformedTest, DamageInTheCaptureCostsNothingOfTheTail) {
  SmallFile file;
  for (Nanoseconds i = 0; i < 5; ++i) file.message(1, i, "in the capture").end_chunk();
  const std::vector<std::byte> capture = file.bytes();
  const std::size_t whole = messages_of(capture, tail_);
  ASSERT_EQ(whole, 7U);
  // A record's length: from there on nothing fits, until the next chunk is found.
  const auto first = std::ranges::search(capture, bytes_of("in the capture")).begin();
  auto damaged = capture;
  const auto next = static_cast<std::size_t>(first - capture.begin()) + 14;
  damaged[next + 7] = std::byte{0xFF};
  EXPECT_GE(messages_of(damaged, tail_), whole - 1);
}

TEST_F(TailMalformedTest, AnythingChangedInBothNeverHurts) {
  std::mt19937 random(7);
  const auto pick = [&](std::size_t below) {
    return std::uniform_int_distribution<std::size_t>(0, below - 1)(random);
  };
  for (int round = 0; round < 3000; ++round) {
    auto capture = capture_;
    auto tail = tail_;
    for (std::size_t i = pick(4); i > 0; --i) {
      // The head of the file stays: without it, it is no capture.
      capture[50 + pick(capture.size() - 50)] = static_cast<std::byte>(pick(256));
    }
    for (std::size_t i = pick(8); i > 0; --i) {
      const bool in_head = pick(2) == 0;
      const std::size_t slot = pick(2) * Tail::slot_size(kSlot);
      tail[slot + (in_head ? pick(32) : Tail::kHead + pick(200))] =
          static_cast<std::byte>(pick(256));
    }
    if (pick(4) == 0) capture.resize(50 + pick(capture.size() - 50));
    if (pick(4) == 0) tail.resize(pick(tail.size()));
    EXPECT_LE(messages_of(capture, tail), 3U) << round;
  }
}

}  // namespace
}  // namespace coop::mcap
