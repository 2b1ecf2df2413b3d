#include "capture/mcap/recover.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/capture_mcap/capture.hpp"

namespace coop::mcap {
namespace {

using test::lines_of;
using test::SmallFile;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;

struct Recovered {
  RecoverReport report;
  std::vector<std::byte> bytes;

  [[nodiscard]] std::vector<std::string> lines() const {
    Reader reader(open_memory(bytes));
    EXPECT_TRUE(reader.summary().complete);
    EXPECT_FALSE(reader.summary().scanned);
    return lines_of(reader);
  }
};

Recovered recovered(const std::vector<std::byte>& bytes) {
  Recovered result;
  result.report = recover(open_memory(bytes), write_to_memory(result.bytes));
  return result;
}

std::vector<std::byte> three_chunks(Compression compression = Compression::kZstd) {
  SmallFile file(compression);
  const std::string text = "the map";
  file.writer().add(Attachment{0, 0, "map.yaml", "text/yaml", test::bytes_of(text)});
  file.message(1, 1, "one").message(2, 2, "two").end_chunk();
  file.message(1, 3, "three").message(1, 4, "four").end_chunk();
  file.message(2, 5, "five").end_chunk();
  file.writer().add(Metadata{"versions", {{"coop", "0.1.0"}}});
  return file.finish();
}

std::uint64_t chunk_offset(const std::vector<std::byte>& bytes, std::size_t index) {
  return Reader(open_memory(bytes)).summary().chunks.at(index).chunk_start_offset;
}

TEST(Recover, ACompleteFileStaysWhatItIs) {
  const std::vector<std::byte> bytes = three_chunks();
  const Recovered result = recovered(bytes);
  EXPECT_TRUE(result.report.was_complete);
  EXPECT_THAT(result.report.notes, IsEmpty());
  EXPECT_EQ(result.report.messages, 5U);
  EXPECT_EQ(result.report.chunks, 3U);
  EXPECT_EQ(result.report.attachments, 1U);
  EXPECT_EQ(result.report.metadata, 1U);
  EXPECT_THAT(result.lines(),
              ElementsAre("/a 1 one", "/b 2 two", "/a 3 three", "/a 4 four", "/b 5 five"));
}

TEST(Recover, AFileCutInAChunkKeepsWhatIsBeforeTheCut) {
  std::vector<std::byte> bytes = three_chunks(Compression::kNone);
  // 'three' is whole, 'four' is not: a message is 31 bytes and its text.
  bytes.resize(chunk_offset(bytes, 1) + 49 + 31 + 5 + 10);
  const Recovered result = recovered(bytes);
  EXPECT_FALSE(result.report.was_complete);
  EXPECT_EQ(result.report.chunks, 1U);
  EXPECT_EQ(result.report.lost_chunks, 1U);
  EXPECT_EQ(result.report.salvaged_messages, 1U);
  EXPECT_THAT(result.report.notes.back(), HasSubstr("1 messages before the cut are saved"));
  EXPECT_THAT(result.lines(), ElementsAre("/a 1 one", "/b 2 two", "/a 3 three"));
}

TEST(Recover, ADamagedChunkIsLeftOutAndItsMessagesAreCounted) {
  std::vector<std::byte> bytes = three_chunks();
  bytes[static_cast<std::size_t>(chunk_offset(bytes, 1)) + 70] ^= std::byte{0x10};
  const Recovered result = recovered(bytes);
  EXPECT_EQ(result.report.lost_chunks, 1U);
  EXPECT_THAT(result.report.lost_messages, ElementsAre(Pair(1, 2)));
  EXPECT_THAT(result.lines(), ElementsAre("/a 1 one", "/b 2 two", "/b 5 five"));
}

TEST(Recover, AfterALengthThatLiesTheNextChunkIsFound) {
  std::vector<std::byte> bytes = three_chunks();
  bytes[static_cast<std::size_t>(chunk_offset(bytes, 1)) + 3] ^= std::byte{0x40};
  const Recovered result = recovered(bytes);
  EXPECT_THAT(result.lines(), ElementsAre("/a 1 one", "/b 2 two", "/b 5 five"));
  EXPECT_GT(result.report.skipped_bytes, 0U);
  EXPECT_EQ(result.report.metadata, 1U) << "what lies behind it is there again";
}

TEST(Recover, GarbageBetweenRecordsIsSkipped) {
  const std::vector<std::byte> whole = three_chunks();
  std::vector<std::byte> bytes = whole;
  const std::vector<std::byte> garbage(1000, std::byte{0x06});
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(chunk_offset(whole, 1)), garbage.begin(),
               garbage.end());
  EXPECT_THAT(recovered(bytes).lines(), SizeIs(5));
}

TEST(Recover, ChannelsThatWereDamagedComeFromTheSummary) {
  std::vector<std::byte> bytes = three_chunks();
  // The topic's length, in the channel record of /a: the first after header and schema.
  const auto topic = std::ranges::search(bytes, test::bytes_of("/a"));
  *(topic.begin() - 1) = std::byte{0xFF};
  const Recovered result = recovered(bytes);
  EXPECT_FALSE(result.report.was_complete);
  EXPECT_THAT(result.lines(), SizeIs(5));
}

TEST(Recover, MessagesOutsideOfChunksGetAnIndex) {
  SmallFile file;
  const std::string text = "x";
  for (Nanoseconds time = 0; time < 4; ++time) {
    file.writer().add(Message{1, 0, time, time, test::bytes_of(text)});
  }
  const Recovered result = recovered(file.finish());
  EXPECT_EQ(result.report.salvaged_messages, 4U);
  EXPECT_THAT(result.lines(), SizeIs(4));
  EXPECT_EQ(Reader(open_memory(result.bytes)).summary().chunks.size(), 1U);
}

TEST(Recover, AttachmentsThatAreDamagedAreLost) {
  std::vector<std::byte> bytes = three_chunks();
  const std::string text = "the map";
  const auto data = std::ranges::search(bytes, test::bytes_of(text));
  *data.begin() ^= std::byte{1};
  const Recovered result = recovered(bytes);
  EXPECT_EQ(result.report.lost_attachments, 1U);
  EXPECT_EQ(result.report.attachments, 0U);
  EXPECT_THAT(result.lines(), SizeIs(5));
}

TEST(Recover, WhatIsNoMcapFileIsAnError) {
  std::vector<std::byte> out;
  EXPECT_THROW(
      static_cast<void>(recover(open_memory(std::vector<std::byte>(100)), write_to_memory(out))),
      FileError);
  EXPECT_THAT(out, IsEmpty());
}

}  // namespace
}  // namespace coop::mcap
