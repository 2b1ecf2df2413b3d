#include "capture/mcap/writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"
#include "unit/capture_mcap/capture.hpp"
#include "unit/capture_mcap/file_size_limit.hpp"

namespace coop::mcap {
namespace {

using coop::test::TemporaryFolder;
using test::bytes_of;
using test::kMillisecond;
using test::lines_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;

std::uint16_t string_channel(Writer& writer, const std::string& topic) {
  return writer.add_channel(writer.add_schema("std_msgs/msg/String", "ros2msg", "string data\n"),
                            topic);
}

bool write(Writer& writer, std::uint16_t channel, Nanoseconds time, const std::string& text) {
  return writer.write({channel, 0, time, time, bytes_of(text)});
}

class WriterCompressionTest : public ::testing::TestWithParam<const char*> {};

TEST_P(WriterCompressionTest, WhatIsWrittenIsRead) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  WriterOptions options;
  options.compression = compression_named(GetParam());
  options.chunk_bytes = 1000;
  std::vector<std::string> expected;
  {
    Writer writer(Series{path}, options);
    const std::uint16_t a = string_channel(writer, "/a");
    const std::uint16_t b = string_channel(writer, "/b");
    for (Nanoseconds i = 0; i < 500; ++i) {
      const std::string text = "message " + std::to_string(i);
      ASSERT_TRUE(write(writer, i % 3 == 0 ? b : a, i * kMillisecond, text));
      expected.push_back((i % 3 == 0 ? "/b " : "/a ") + std::to_string(i * kMillisecond) + " " +
                         text);
    }
    writer.close();
    EXPECT_EQ(writer.status().messages, 500U);
    EXPECT_EQ(writer.status().lost(), 0U);
    EXPECT_EQ(writer.status().error, "");
    EXPECT_EQ(writer.status().bytes, std::filesystem::file_size(path));
  }
  Reader reader(path);
  EXPECT_EQ(lines_of(reader), expected);
  const Summary& summary = reader.summary();
  EXPECT_TRUE(summary.complete);
  EXPECT_FALSE(summary.scanned);
  EXPECT_EQ(summary.header.profile, "ros2");
  EXPECT_EQ(summary.statistics->message_count, 500U);
  EXPECT_THAT(summary.statistics->channel_message_counts, ElementsAre(Pair(1, 333), Pair(2, 167)));
  EXPECT_EQ(summary.statistics->message_end_time, 499 * kMillisecond);
  EXPECT_GT(summary.chunks.size(), 20U);
  EXPECT_EQ(summary.chunks.front().compression, name_of(options.compression));
  EXPECT_EQ(summary.schema_of(summary.channels.at(1))->data, "string data\n");
}

INSTANTIATE_TEST_SUITE_P(All, WriterCompressionTest, ::testing::Values("none", "lz4", "zstd"));

TEST(Writer, TheSameSchemaOrChannelIsWrittenOnce) {
  const TemporaryFolder folder;
  Writer writer(Series{folder.path() / "a.mcap"});
  EXPECT_EQ(string_channel(writer, "/a"), string_channel(writer, "/a"));
  EXPECT_NE(string_channel(writer, "/a"), string_channel(writer, "/b"));
  EXPECT_NE(writer.add_channel(1, "/a", "cdr", {{"offered_qos_profiles", "x"}}),
            string_channel(writer, "/a"));
  EXPECT_THROW(writer.add_channel(7, "/c"), std::invalid_argument);
}

TEST(Writer, AChunkIsOnTheDiskWhenItIsOld) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  WriterOptions options;
  options.chunk_age = 10 * kMillisecond;
  Writer writer(Series{path}, options);
  const std::uint16_t a = string_channel(writer, "/a");
  write(writer, a, 0, "first");
  write(writer, a, 9 * kMillisecond, "second");
  write(writer, a, 10 * kMillisecond, "third");
  write(writer, a, 11 * kMillisecond, "fourth");
  writer.close_aged_chunk(12 * kMillisecond);
  const auto chunks = [&] { return scan(open_file(path)).chunks.size(); };
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (chunks() < 1 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  EXPECT_EQ(chunks(), 1U) << "the second one is not old enough";
  writer.close_aged_chunk(20 * kMillisecond);
  while (chunks() < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  EXPECT_EQ(chunks(), 2U);
}

TEST(Writer, SplitsBySizeIntoCompleteFiles) {
  const TemporaryFolder folder;
  WriterOptions options;
  options.compression = Compression::kNone;
  options.chunk_bytes = 1000;
  Writer writer(Series{folder.path() / "run.mcap", 5000}, options);
  const std::uint16_t a = string_channel(writer, "/a");
  const std::string map = "the map";
  writer.attach({0, 0, "map.yaml", "text/yaml", bytes_of(map)});
  writer.attach({0, 0, "once.txt", "text/plain", bytes_of(map)}, Where::kThisFile);
  writer.add(Metadata{"versions", {{"coop", "0.1.0"}}});
  for (Nanoseconds i = 0; i < 200; ++i) write(writer, a, i, std::string(50, 'x'));
  writer.close();
  const WriterStatus status = writer.status();
  ASSERT_GT(status.files.size(), 2U);
  EXPECT_EQ(status.files[0].filename(), "run_0001.mcap");
  EXPECT_EQ(status.files[1].filename(), "run_0002.mcap");
  std::size_t messages = 0;
  for (std::size_t i = 0; i < status.files.size(); ++i) {
    EXPECT_LT(std::filesystem::file_size(status.files[i]), 7000U);
    Reader reader(status.files[i]);
    ASSERT_TRUE(reader.summary().complete);
    messages += lines_of(reader).size();
    ASSERT_THAT(reader.summary().attachments, SizeIs(i == 0 ? 2 : 1));
    const OwnedAttachment owned = reader.attachment(reader.summary().attachments[0]);
    EXPECT_EQ(test::text_of(owned.attachment.data), map);
    ASSERT_THAT(reader.summary().metadata, SizeIs(1));
    EXPECT_EQ(reader.metadata(reader.summary().metadata[0]).metadata.at("coop"), "0.1.0");
  }
  EXPECT_EQ(messages, 200U);
}

TEST(Writer, SplitsByTime) {
  const TemporaryFolder folder;
  WriterOptions options;
  options.chunk_age = 10;
  options.when_full = WhenFull::kWait;
  Writer writer(Series{folder.path() / "run.mcap", 0, 50}, options);
  const std::uint16_t a = string_channel(writer, "/a");
  for (Nanoseconds i = 0; i < 200; ++i) write(writer, a, 1000 + i, "x");
  writer.close();
  EXPECT_THAT(writer.status().files, SizeIs(4));
}

TEST(Writer, AChannelWithoutMessagesIsInTheFile) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  {
    Writer writer(Series{path});
    string_channel(writer, "/silent");
  }
  EXPECT_EQ(Reader(path).summary().channels.at(1).topic, "/silent");
}

TEST(Writer, WhatFindsNoRoomIsCountedByChannel) {
  const TemporaryFolder folder;
  WriterOptions options;
  options.chunk_bytes = 100'000;
  options.queue_bytes = 1;  // two chunks there are always
  options.compression = Compression::kZstd;
  options.level = 19;  // slow
  Writer writer(Series{folder.path() / "a.mcap"}, options);
  const std::uint16_t a = string_channel(writer, "/a");
  const std::string text(20'000, 'x');
  std::uint64_t taken = 0;
  std::uint64_t refused = 0;
  for (Nanoseconds i = 0; i < 10'000 && refused < 3; ++i) {
    ++(write(writer, a, i, text) ? taken : refused);
  }
  writer.close();
  EXPECT_EQ(refused, 3U);
  EXPECT_THAT(writer.status().lost_messages, ElementsAre(Pair(a, 3)));
  EXPECT_EQ(writer.status().messages, taken);
  Reader reader(folder.path() / "a.mcap");
  EXPECT_EQ(lines_of(reader).size(), taken);
}

TEST(Writer, AFileThatCannotBeWrittenIsAnErrorAtTheStart) {
  EXPECT_THROW(Writer(Series{"/dev/full"}), std::system_error);
  EXPECT_THROW(Writer(Series{"/nowhere/a.mcap"}), std::system_error);
}

/// More than the disk has.
std::uint64_t far_too_much(const std::filesystem::path& folder) {
  return 2 * std::filesystem::space(folder).available;
}

TEST(Disk, KeepsItsReserveForOthers) {
  const TemporaryFolder folder;
  WriterOptions options;
  options.file.reserve = far_too_much(folder.path());
  EXPECT_THROW(Writer(Series{folder.path() / "a.mcap"}, options), std::system_error);
}

TEST(Disk, ThatIsTooFullForARingGetsNoPartOfIt) {
  const TemporaryFolder folder;
  WriterOptions options;
  options.file.reserve = far_too_much(folder.path());
  Writer writer(Ring{}, options);
  EXPECT_THROW(writer.snapshot(folder.path() / "a.mcap").get(), std::system_error);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.mcap"));
}

TEST(Writer, WhenTheDiskIsFullTheFileEndsWithItsLastWholeChunk) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  WriterStatus status;
  {
    const test::FileSizeLimit limit(20'000);
    WriterOptions options;
    options.compression = Compression::kNone;
    options.chunk_bytes = 3'000;
    options.when_full = WhenFull::kWait;
    Writer writer(Series{path}, options);
    const std::uint16_t a = string_channel(writer, "/a");
    for (Nanoseconds i = 0; i < 1000; ++i) write(writer, a, i, std::string(100, 'x'));
    writer.close();
    status = writer.status();
  }
  EXPECT_THAT(status.error, HasSubstr(path.string()));
  EXPECT_GT(status.lost(), 800U);
  Reader reader(path);
  const std::size_t read = lines_of(reader).size();
  EXPECT_GT(read, 50U);
  EXPECT_EQ(read + status.lost(), 1000U) << "each message is in the file or counted as lost";
}

TEST(Writer, TheRingKeepsTheLastSecondsAndWritesThemOnDemand) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "fault.mcap";
  WriterOptions options;
  options.chunk_age = 10;
  options.when_full = WhenFull::kWait;
  Writer writer(Ring{100, 1'000'000}, options);
  const std::uint16_t a = string_channel(writer, "/a");
  const std::string urdf = "<robot/>";
  writer.attach({0, 0, "robot.urdf", "text/xml", bytes_of(urdf)});
  for (Nanoseconds i = 0; i < 1000; ++i) write(writer, a, i, "x");
  EXPECT_THAT(writer.snapshot(path).get(), testing::AllOf(testing::Ge(100U), testing::Le(120U)));
  for (Nanoseconds i = 1000; i < 1050; ++i) write(writer, a, i, "x");
  EXPECT_GE(writer.snapshot(folder.path() / "later.mcap").get(), 100U);
  Reader reader(path);
  EXPECT_TRUE(reader.summary().complete);
  EXPECT_THAT(reader.summary().attachments, SizeIs(1));
  const auto lines = lines_of(reader);
  EXPECT_EQ(lines.back(), "/a 999 x");
  Reader later(folder.path() / "later.mcap");
  EXPECT_EQ(lines_of(later).back(), "/a 1049 x");
}

TEST(Writer, TheRingIsBoundedInBytes) {
  WriterOptions options;
  options.compression = Compression::kNone;
  options.chunk_bytes = 1000;
  options.when_full = WhenFull::kWait;
  Writer writer(Ring{~Nanoseconds{0}, 10'000}, options);
  const std::uint16_t a = string_channel(writer, "/a");
  for (Nanoseconds i = 0; i < 2000; ++i) write(writer, a, i, std::string(50, 'x'));
  writer.flush();
  EXPECT_GT(writer.status().bytes, 5'000U);
  EXPECT_LE(writer.status().bytes, 10'000U);
}

TEST(Writer, ASnapshotOfACaptureIntoFilesIsAnError) {
  const TemporaryFolder folder;
  Writer writer(Series{folder.path() / "a.mcap"});
  EXPECT_THROW(writer.snapshot(folder.path() / "b.mcap").get(), std::logic_error);
}

TEST(Writer, ManyThreadsWriteIntoOneFile) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  {
    WriterOptions options;
    options.chunk_bytes = 10'000;
    options.when_full = WhenFull::kWait;
    Writer writer(Series{path}, options);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&writer, t] {
        const std::uint16_t channel = string_channel(writer, "/" + std::to_string(t));
        for (Nanoseconds i = 0; i < 1000; ++i) write(writer, channel, i, "some text");
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  Reader reader(path);
  EXPECT_EQ(lines_of(reader).size(), 4000U);
  EXPECT_EQ(lines_of(reader, {.topics = {"/2"}}).size(), 1000U);
}

}  // namespace
}  // namespace coop::mcap
