#include "capture/mcap/reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "unit/capture_mcap/capture.hpp"

namespace coop::mcap {
namespace {

using test::lines_of;
using test::SmallFile;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Three chunks that overlap: 0-30, 10-40, 20-50.
std::vector<std::byte> overlapping(Compression compression = Compression::kZstd,
                                   const Layout& layout = {}) {
  SmallFile file(compression, layout);
  file.message(1, 0, "p").message(2, 30, "q").message(1, 15, "r").end_chunk();
  file.message(1, 40, "s").message(1, 10, "t").end_chunk();
  file.message(2, 20, "u").message(2, 50, "v").message(1, 30, "w").end_chunk();
  return file.finish();
}

TEST(Reader, GivesMessagesByTimeAcrossChunksThatOverlap) {
  Reader reader(open_memory(overlapping()));
  EXPECT_THAT(lines_of(reader), ElementsAre("/a 0 p", "/a 10 t", "/a 15 r", "/b 20 u", "/b 30 q",
                                            "/a 30 w", "/a 40 s", "/b 50 v"));
}

TEST(Reader, GivesMessagesAsRecordedIfAsked) {
  Reader reader(open_memory(overlapping()));
  EXPECT_THAT(lines_of(reader, {.order = Order::kFile}),
              ElementsAre("/a 0 p", "/b 30 q", "/a 15 r", "/a 40 s", "/a 10 t", "/b 20 u",
                          "/b 50 v", "/a 30 w"));
}

TEST(Reader, ATimeRangeHoldsItsBeginAndNotItsEnd) {
  Reader reader(open_memory(overlapping()));
  EXPECT_THAT(lines_of(reader, {.start = 10, .end = 30}),
              ElementsAre("/a 10 t", "/a 15 r", "/b 20 u"));
  EXPECT_THAT(lines_of(reader, {.start = 51}), IsEmpty());
  EXPECT_THAT(lines_of(reader, {.start = 50}), ElementsAre("/b 50 v"));
}

TEST(Reader, ATimeAtTheEndOfTimeIsRead) {
  constexpr Nanoseconds kLast = ~Nanoseconds{0};
  Reader reader(open_memory(SmallFile().message(1, kLast, "x").finish()));
  EXPECT_THAT(lines_of(reader), SizeIs(1));
}

TEST(Reader, SelectsTopics) {
  Reader reader(open_memory(overlapping()));
  EXPECT_THAT(lines_of(reader, {.topics = {"/b"}}), ElementsAre("/b 20 u", "/b 30 q", "/b 50 v"));
  EXPECT_THAT(lines_of(reader, {.topics = {"/c"}}), IsEmpty());
}

TEST(Reader, GivesTheSameWithLittleMemory) {
  ReadLimits limits;
  limits.chunk_cache = 1;
  Reader small(open_memory(overlapping()), limits);
  Reader large(open_memory(overlapping()));
  EXPECT_EQ(lines_of(small), lines_of(large));
}

TEST(Reader, SeveralCursorsAreOpenAtATime) {
  Reader reader(open_memory(overlapping()));
  MessageCursor first = reader.messages();
  MessageCursor second = reader.messages({.start = 40});
  EXPECT_EQ(first.next()->message.log_time, 0U);
  EXPECT_EQ(second.next()->message.log_time, 40U);
  EXPECT_EQ(first.next()->message.log_time, 10U);
  EXPECT_EQ(second.next()->message.log_time, 50U);
  EXPECT_FALSE(second.next().has_value());
  EXPECT_FALSE(second.next().has_value());
}

/// Whatever a file leaves out of its summary, the messages are found.
class ReaderLayoutTest : public ::testing::TestWithParam<unsigned> {};

TEST_P(ReaderLayoutTest, ReadsTheSame) {
  const unsigned bits = GetParam();
  Layout layout;
  layout.message_index = (bits & 1U) != 0;
  layout.chunk_index = (bits & 2U) != 0;
  layout.statistics = (bits & 4U) != 0;
  layout.repeated_channels = layout.repeated_schemas = (bits & 8U) != 0;
  layout.summary_offsets = false;
  Reader full(open_memory(overlapping()));
  Reader reader(open_memory(overlapping(Compression::kLz4, layout)));
  EXPECT_TRUE(reader.summary().complete) << reader.summary().defect;
  EXPECT_EQ(lines_of(reader), lines_of(full));
  EXPECT_EQ(lines_of(reader, {.topics = {"/b"}}), lines_of(full, {.topics = {"/b"}}));
}
INSTANTIATE_TEST_SUITE_P(All, ReaderLayoutTest, ::testing::Range(0U, 16U));

TEST(Reader, MessagesOutsideOfChunksAreReadByTime) {
  SmallFile file;
  const std::string text = "x";
  for (const Nanoseconds time : {5U, 3U, 9U, 1U}) {
    file.writer().add(Message{1, 0, time, time, test::bytes_of(text)});
  }
  Reader reader(open_memory(file.finish()));
  EXPECT_THAT(lines_of(reader), ElementsAre("/a 1 x", "/a 3 x", "/a 5 x", "/a 9 x"));
}

TEST(Reader, AFileWhoseWriterWasKilledIsReadUpToItsLastWholeChunk) {
  SmallFile file(Compression::kZstd);
  file.message(1, 1, "first").end_chunk().message(2, 2, "second").end_chunk();
  std::vector<std::byte> bytes = file.bytes();
  Reader whole(open_memory(bytes));
  EXPECT_FALSE(whole.summary().complete);
  EXPECT_TRUE(whole.summary().scanned);
  EXPECT_THAT(whole.summary().defect, HasSubstr("the file ends without DataEnd"));
  EXPECT_THAT(lines_of(whole), ElementsAre("/a 1 first", "/b 2 second"));
  EXPECT_EQ(whole.summary().statistics->message_count, 2U);
  bytes.resize(bytes.size() - 60);  // into the last chunk
  Reader cut(open_memory(bytes, "cut.mcap"));
  EXPECT_THAT(lines_of(cut), ElementsAre("/a 1 first"));
  EXPECT_THAT(cut.summary().defect, HasSubstr("bytes long where"));
}

TEST(Reader, WhatIsNoMcapFileIsAnErrorThatNamesIt) {
  const auto open = [](const std::string& text) {
    const Bytes bytes = test::bytes_of(text);
    Reader reader(open_memory({bytes.begin(), bytes.end()}, "photo.png"));
  };
  EXPECT_THAT([&] { open("\x89PNG\r\n"); },
              testing::ThrowsMessage<FileError>(HasSubstr("photo.png: byte 0: this is no MCAP")));
  EXPECT_THAT([&] { open(""); }, testing::ThrowsMessage<FileError>(HasSubstr("no MCAP file")));
  EXPECT_THROW(Reader("/nowhere/a.mcap"), std::system_error);
  EXPECT_THROW(Reader("/tmp"), std::system_error);
}

TEST(Reader, ADamagedChunkIsAnErrorAtItsPlace) {
  std::vector<std::byte> bytes = SmallFile().message(1, 1, "some text").finish();
  const std::uint64_t chunk = Reader(open_memory(bytes)).summary().chunks[0].chunk_start_offset;
  bytes[static_cast<std::size_t>(chunk) + 80] ^= std::byte{1};
  Reader reader(open_memory(bytes, "a.mcap"));
  EXPECT_THAT([&] { lines_of(reader); },
              testing::ThrowsMessage<FileError>(HasSubstr("a.mcap: byte " + std::to_string(chunk) +
                                                          ": Chunk: it has been damaged")));
}

TEST(Reader, ADamagedSummaryIsReplacedByAScan) {
  std::vector<std::byte> bytes = overlapping();
  bytes[bytes.size() - 200] ^= std::byte{1};
  Reader reader(open_memory(bytes));
  EXPECT_FALSE(reader.summary().complete);
  EXPECT_THAT(reader.summary().defect, HasSubstr("summary has been damaged"));
  EXPECT_THAT(lines_of(reader), SizeIs(8));
}

TEST(Reader, AChunkThatPromisesTooMuchIsRefused) {
  ReadLimits limits;
  limits.max_chunk = 50;
  Reader reader(open_memory(overlapping()), limits);
  EXPECT_THAT([&] { lines_of(reader); },
              testing::ThrowsMessage<FileError>(HasSubstr("at most 50 are read")));
}

TEST(Reader, AMessageOfAChannelThatIsNowhereIsAnError) {
  SmallFile file;
  Reader reader(open_memory(file.message(9, 1, "x").finish()));
  EXPECT_THAT([&] { lines_of(reader); },
              testing::ThrowsMessage<FileError>(HasSubstr("a message of channel 9")));
}

TEST(Reader, AttachmentsAreCheckedAgainstTheirCrc) {
  SmallFile file;
  const std::string text = "calibration: 1";
  file.writer().add(Attachment{1, 2, "camera.yaml", "text/yaml", test::bytes_of(text)});
  std::vector<std::byte> bytes = file.finish();
  Reader reader(open_memory(bytes));
  const AttachmentIndex index = reader.summary().attachments.at(0);
  EXPECT_EQ(test::text_of(reader.attachment(index).attachment.data), text);
  EXPECT_EQ(index.data_size, text.size());
  bytes[static_cast<std::size_t>(index.offset + index.length) - 6] ^= std::byte{4};
  EXPECT_THAT([&] { static_cast<void>(Reader(open_memory(bytes)).attachment(index)); },
              testing::ThrowsMessage<FileError>(HasSubstr("'camera.yaml' has been damaged")));
  AttachmentIndex wrong = index;
  wrong.length = ~std::uint64_t{0};
  EXPECT_THROW(static_cast<void>(Reader(open_memory(bytes)).attachment(wrong)), FileError);
}

}  // namespace
}  // namespace coop::mcap
