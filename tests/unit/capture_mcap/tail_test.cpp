// What a writer has in memory lies in a file beside the capture, and is read with it.
#include "capture/mcap/tail.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "capture/mcap/recover.hpp"
#include "support/temporary_folder.hpp"
#include "unit/capture_mcap/capture.hpp"

namespace coop::mcap {
namespace {

using test::bytes_of;
using test::kMillisecond;
using test::lines_of;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

class TailTest : public ::testing::Test {
 protected:
  void open(const Series& series, std::size_t chunk_bytes = 4000,
            std::size_t queue_bytes = std::size_t{64} << 20U) {
    WriterOptions options;
    options.queue_bytes = queue_bytes;
    options.chunk_bytes = chunk_bytes;
    options.when_full = WhenFull::kWait;
    options.tail = true;
    writer_.emplace(series, options);
  }
  std::uint16_t channel(const std::string& topic) {
    return writer_->add_channel(
        writer_->add_schema("std_msgs/msg/String", "ros2msg", "string data"), topic);
  }
  void write(std::uint16_t channel, Nanoseconds time, const std::string& text) {
    ASSERT_TRUE(writer_->write({channel, 0, time, time, bytes_of(text)}));
  }
  /// As after a kill: the files as they are now.
  std::filesystem::path copy(const std::filesystem::path& capture) const {
    const auto killed = folder_.path() / "killed";
    std::filesystem::create_directories(killed);
    const auto tail = Tail::path_of(path());
    std::filesystem::copy_file(tail, killed / tail.filename());
    std::filesystem::copy_file(capture, killed / capture.filename());
    return killed / capture.filename();
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "a.mcap"; }

  coop::test::TemporaryFolder folder_;
  std::optional<Writer> writer_;
};

TEST_F(TailTest, OfAKilledWriterEveryMessageIsReadThatItHadTaken) {
  open({path()});
  write(channel("/a"), 1, "one");
  write(channel("/b"), 2, "two");
  Reader reader(copy(path()));
  EXPECT_FALSE(reader.summary().complete);
  EXPECT_THAT(lines_of(reader), ElementsAre("/a 1 one", "/b 2 two"));
  std::vector<std::byte> bytes;
  const auto report = recover(open_file(folder_.path() / "killed/a.mcap"), write_to_memory(bytes));
  EXPECT_EQ(report.messages, 2U);
  EXPECT_EQ(report.lost_chunks, 0U);
  Reader recovered(open_memory(std::move(bytes)));
  EXPECT_TRUE(recovered.summary().complete);
  EXPECT_EQ(recovered.summary().schema_of(recovered.summary().channels.at(1))->name,
            "std_msgs/msg/String");
  EXPECT_THAT(lines_of(recovered), ElementsAre("/a 1 one", "/b 2 two"));
}

TEST_F(TailTest, ChunksThatAreInTheCaptureAreNotReadTwice) {
  open({path()});
  const auto a = channel("/a");
  const std::string text(1000, 'x');
  for (Nanoseconds i = 0; i < 50; ++i) write(a, i, text);
  Reader alive(path());
  EXPECT_THAT(lines_of(alive), SizeIs(50));
  writer_->flush();
  write(a, 50, text);
  Reader killed(copy(path()));
  EXPECT_THAT(lines_of(killed), SizeIs(51));
}

TEST_F(TailTest, AClosedCaptureHasNone) {
  open({path()});
  write(channel("/a"), 1, "one");
  EXPECT_TRUE(std::filesystem::exists(Tail::path_of(path())));
  writer_->close();
  EXPECT_FALSE(std::filesystem::exists(Tail::path_of(path())));
  Reader reader(path());
  EXPECT_TRUE(reader.summary().complete);
  EXPECT_THAT(lines_of(reader), ElementsAre("/a 1 one"));
}

TEST_F(TailTest, ThePartsOfACaptureHaveOne) {
  open({.path = path(), .split_duration = kMillisecond});
  const auto a = channel("/a");
  write(a, 0, "first");
  writer_->flush();
  write(a, 5 * kMillisecond, "second");
  writer_->flush();
  write(a, 5 * kMillisecond + 1, "third");
  ASSERT_THAT(writer_->status().files, SizeIs(2));
  Reader last(copy(writer_->status().files[1]));
  EXPECT_THAT(lines_of(last), ElementsAre("/a 5000000 second", "/a 5000001 third"));
  Reader first(writer_->status().files[0]);
  EXPECT_TRUE(first.summary().complete);
  EXPECT_THAT(lines_of(first), ElementsAre("/a 0 first"));
}

TEST_F(TailTest, AFileThatBeginsAnewHasItWithAllThatExplainsIt) {
  open({path()});
  const auto a = channel("/a");
  write(a, 100, "before");
  const auto second = folder_.path() / "b.mcap";
  writer_->begin_anew(second);
  writer_->flush();
  write(a, 1, "after");
  EXPECT_FALSE(std::filesystem::exists(Tail::path_of(path())));
  Reader killed(second);
  EXPECT_FALSE(killed.summary().complete);
  EXPECT_THAT(lines_of(killed), ElementsAre("/a 1 after"));
  Reader first(path());
  EXPECT_TRUE(first.summary().complete);
  EXPECT_THAT(lines_of(first), ElementsAre("/a 100 before"));
}

TEST_F(TailTest, AMessageLargerThanAChunkIsInItToo) {
  open({path()});
  const auto a = channel("/a");
  const std::string large(200'000, 'x');
  const std::vector<std::string> lines{"/a 1 small", "/a 2 " + large, "/a 3 small",
                                       "/a 4 " + large};
  write(a, 1, "small");
  write(a, 2, large);
  write(a, 3, "small");
  write(a, 4, large);
  Reader killed(copy(path()));
  EXPECT_EQ(lines_of(killed), lines);
  writer_->close();
  Reader reader(path());
  EXPECT_EQ(lines_of(reader), lines);
}

TEST_F(TailTest, LargeMessagesDoNotMakeItGrowForEver) {
  open({path()}, 4000, 1);
  const auto a = channel("/a");
  for (Nanoseconds i = 0; i < 1000; ++i) {
    write(a, i, std::string(i % 10 == 9 ? 50'000 + 1000 * (i % 200) : 3000, 'x'));
  }
  // Two chunks in memory, each of them in slots of 4, 64, 128 and 256 KiB one after the other.
  EXPECT_LE(std::filesystem::file_size(Tail::path_of(path())), 1'000'000U);
  struct stat status {};
  ASSERT_EQ(::stat(Tail::path_of(path()).c_str(), &status), 0);
  EXPECT_LE(status.st_blocks * 512, 600'000) << "what is no longer used was not given back";
}

TEST_F(TailTest, ManyNewChannelsAtOnceAreStillInIt) {
  open({path()});
  write(channel("/first"), 1, std::string(3000, 'x'));
  const auto schema = writer_->add_schema("large", "ros2msg", std::string(300'000, 's'));
  write(writer_->add_channel(schema, "/second"), 2, "text");
  Reader killed(copy(path()));
  EXPECT_THAT(lines_of(killed),
              ElementsAre("/first 1 " + std::string(3000, 'x'), "/second 2 text"));
}

TEST_F(TailTest, WhatIsNoTailIsLeftAlone) {
  open({path()});
  write(channel("/a"), 1, "one");
  writer_->flush();
  const auto killed = copy(path());
  for (const std::string& nonsense :
       {std::string(), std::string(100, 'x'), std::string(9000, 'x')}) {
    std::ofstream(Tail::path_of(killed), std::ios::binary) << nonsense;
    Reader reader(killed);
    EXPECT_THAT(lines_of(reader), ElementsAre("/a 1 one")) << nonsense.size();
  }
}

TEST_F(TailTest, ATailThatWasCutOrChangedNeverHurts) {
  open({path()}, 100'000);
  const auto a = channel("/a");
  for (Nanoseconds i = 0; i < 20; ++i) write(a, i, std::string(300, 'x'));
  const auto killed = copy(path());
  const auto tail = Tail::path_of(killed);
  const auto whole = test::content_of(*open_plain_file(tail));
  for (std::size_t i = 0; i < 200; ++i) {
    auto bytes = whole;
    if (i % 2 == 0) bytes.resize(whole.size() * i / 200);
    const std::size_t at = i % 4 == 1 ? i / 4 : (Tail::kHead + i * 37) % whole.size();
    if (at < bytes.size()) bytes[at] ^= std::byte{0x41};
    std::ofstream(tail, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    std::vector<std::byte> out;
    const auto report = recover(open_file(killed), write_to_memory(out));
    EXPECT_LE(report.messages, 20U);
    Reader reader(open_memory(std::move(out)));
    EXPECT_TRUE(reader.summary().complete) << i;
  }
}

}  // namespace
}  // namespace coop::mcap
