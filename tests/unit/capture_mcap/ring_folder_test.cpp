/// A ring that outlives its process, and what is made of it.
#include "capture/mcap/ring_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "capture/mcap/ring_rescue.hpp"
#include "support/temporary_folder.hpp"
#include "unit/capture_mcap/capture.hpp"
#include "unit/capture_mcap/file_size_limit.hpp"

namespace coop::mcap {
namespace {

using test::bytes_of;
using test::lines_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class RingFolderTest : public ::testing::Test {
 protected:
  RingFolderTest() {
    std::filesystem::create_directories(folder_.path() / "run");
    ring_ = {.duration = 100,
             .max_bytes = 1'000'000,
             .folder = folder_.path() / "coop-ring-a",
             .origin = folder_.path() / "run/captures/killed.mcap"};
  }
  void open() {
    WriterOptions options;
    options.chunk_age = 10;
    options.chunk_bytes = 20'000;
    options.compression = Compression::kNone;
    options.when_full = WhenFull::kWait;
    options.tail = true;
    writer_.emplace(ring_, options);
  }
  std::uint16_t channel(const std::string& topic) {
    return writer_->add_channel(
        writer_->add_schema("std_msgs/msg/String", "ros2msg", "string data"), topic);
  }
  /// The last ones are in a chunk in making when it returns, and nothing moves.
  void write(std::uint16_t channel, Nanoseconds first, Nanoseconds end, std::size_t size = 1) {
    for (Nanoseconds i = first; i < end; ++i) {
      if (i + 5 == end) writer_->flush();
      ASSERT_TRUE(writer_->write(
          {channel, static_cast<std::uint32_t>(i), i, i, bytes_of(std::string(size, 'x'))}));
    }
  }
  /// As after a kill: the folder as it is now, in a folder of such.
  std::filesystem::path copy() const {
    const auto killed = folder_.path() / "killed";
    std::filesystem::create_directories(killed);
    std::filesystem::copy(ring_.folder, killed / ring_.folder.filename(),
                          std::filesystem::copy_options::recursive);
    return killed / ring_.folder.filename();
  }
  /// Numbers of the messages in the order of the file.
  static std::vector<std::uint32_t> sequences(const std::filesystem::path& capture) {
    std::vector<std::uint32_t> all;
    Reader reader(capture);
    MessageCursor cursor = reader.messages({.order = Order::kFile});
    while (const auto read = cursor.next()) all.push_back(read->message.sequence);
    return all;
  }
  static void expect_every_number_up_to(std::uint32_t last, std::uint32_t first,
                                        const std::vector<std::uint32_t>& numbers) {
    ASSERT_THAT(numbers, testing::Not(IsEmpty()));
    EXPECT_LE(numbers.front(), first);
    EXPECT_EQ(numbers.back(), last);
    for (std::size_t i = 1; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], numbers[i - 1] + 1);
  }

  coop::test::TemporaryFolder folder_;
  Ring ring_;
  std::optional<Writer> writer_;
};

TEST_F(RingFolderTest, OfAKilledRingTheLastSecondsAreReadToTheLastMessage) {
  open();
  write(channel("/a"), 0, 1000);
  const auto killed = copy();
  Reader reader(killed);
  EXPECT_FALSE(reader.summary().complete);
  expect_every_number_up_to(999, 900, sequences(killed));
  EXPECT_GE(sequences(killed).front(), 850U) << "the oldest go";
  EXPECT_EQ(reader.summary().schema_of(reader.summary().channels.at(1))->name,
            "std_msgs/msg/String");
}

TEST_F(RingFolderTest, ItBecomesACaptureWhereItBelongs) {
  open();
  const std::string urdf = "<robot/>";
  writer_->attach({0, 0, "robot.urdf", "text/xml", bytes_of(urdf)});
  writer_->add(Metadata{"coop", {{"robot", "a"}}});
  write(channel("/a"), 0, 300);
  writer_->flush();
  write(channel("/b"), 300, 305);
  const auto killed = copy();
  auto dead = DeadRing::all_in(killed.parent_path());
  ASSERT_THAT(dead, SizeIs(1));
  EXPECT_THAT(DeadRing::all_in(killed.parent_path()), IsEmpty()) << "somebody is at it";
  const auto written = dead[0].write({"coop.saved", {{"reason", "killed"}}});
  EXPECT_GE(written.messages, 105U);
  EXPECT_EQ(written.path, ring_.origin);
  EXPECT_FALSE(std::filesystem::exists(killed));
  Reader reader(ring_.origin);
  EXPECT_TRUE(reader.summary().complete);
  expect_every_number_up_to(304, 205, sequences(ring_.origin));
  ASSERT_THAT(reader.summary().attachments, SizeIs(1));
  EXPECT_EQ(reader.attachment(reader.summary().attachments[0]).attachment.name, "robot.urdf");
  ASSERT_THAT(reader.summary().metadata, SizeIs(2));
  EXPECT_EQ(reader.metadata(reader.summary().metadata[1]).metadata.at("reason"), "killed");
  EXPECT_FALSE(std::filesystem::exists(ring_.origin.string() + ".part"));
}

TEST_F(RingFolderTest, ALivingOneIsNobodyElsesAndAClosedOneLeavesNothing) {
  open();
  write(channel("/a"), 0, 1000);
  EXPECT_THAT(DeadRing::all_in(folder_.path()), IsEmpty());
  EXPECT_TRUE(std::filesystem::exists(ring_.folder));
  writer_->close();
  EXPECT_FALSE(std::filesystem::exists(ring_.folder));
}

TEST_F(RingFolderTest, WhereTheRunIsGoneNothingIsWritten) {
  open();
  write(channel("/a"), 0, 10);
  copy();
  std::filesystem::remove_all(folder_.path() / "run");
  for (DeadRing& dead : DeadRing::all_in(folder_.path() / "killed")) dead.write({"a", {}});
  EXPECT_FALSE(std::filesystem::exists(ring_.origin));
  EXPECT_THAT(DeadRing::all_in(folder_.path() / "killed"), IsEmpty());
}

TEST_F(RingFolderTest, WhatCannotBeWrittenStaysForTheNextTry) {
  open();
  write(channel("/a"), 0, 10);
  copy();
  std::ofstream(folder_.path() / "run/captures") << "no folder";
  EXPECT_THROW(DeadRing::all_in(folder_.path() / "killed").at(0).write({"a", {}}),
               std::system_error);
  const auto far_too_much = 2 * std::filesystem::space(folder_.path()).available;
  std::filesystem::remove(folder_.path() / "run/captures");
  EXPECT_THROW(DeadRing::all_in(folder_.path() / "killed").at(0).write({"a", {}}, far_too_much),
               std::system_error);
  EXPECT_THAT(std::vector<std::filesystem::path>(
                  std::filesystem::directory_iterator(ring_.origin.parent_path()), {}),
              IsEmpty());
  EXPECT_EQ(DeadRing::all_in(folder_.path() / "killed").at(0).write({"a", {}}).messages, 10U);
  copy();
  EXPECT_EQ(DeadRing::all_in(folder_.path() / "killed").at(0).write({"a", {}}).path.filename(),
            "killed-2.mcap")
      << "the first stays";
}

TEST_F(RingFolderTest, WhatWasSaidBeforeIsThereOnceDatedToTheBegin) {
  std::uint16_t map = 0;
  ring_.said_before = [&](Nanoseconds begin) {
    std::vector<StoredMessage> said;
    said.emplace_back(Message{map, 7, begin, 1, {}}, bytes_of("the map"));
    return said;
  };
  open();
  map = channel("/map");
  write(channel("/a"), 0, 1000);
  Reader reader(copy());
  const auto maps = lines_of(reader, {.topics = {"/map"}});
  ASSERT_THAT(maps, SizeIs(1));
  const auto first = lines_of(reader, {.topics = {"/a"}}).front();
  EXPECT_EQ(maps[0], "/map " + first.substr(3, first.find(' ', 3) - 3) + " the map");
}

TEST_F(RingFolderTest, ATimeThatBeginsAnewLeavesNothingOfTheOneBefore) {
  open();
  const auto a = channel("/a");
  write(a, 500, 600);
  writer_->begin_anew({});
  write(a, 0, 10);
  writer_->flush();
  EXPECT_THAT(sequences(copy()), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
}

TEST_F(RingFolderTest, ItsFilesAreBoundedInBytes) {
  ring_.duration = ~Nanoseconds{0};
  ring_.max_bytes = 100'000;
  open();
  write(channel("/a"), 0, 20'000, 50);
  writer_->flush();
  std::uint64_t bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(ring_.folder)) {
    if (file.path().extension() == ".mcap") bytes += file.file_size();
  }
  EXPECT_GT(bytes, 50'000U);
  EXPECT_LE(bytes, 125'000U);
}

TEST_F(RingFolderTest, WithoutAFolderItIsInMemoryAndSaysSo) {
  ring_.folder = folder_.path() / "nowhere/coop-ring-a";
  open();
  EXPECT_THAT(writer_->status().warning, HasSubstr("nowhere"));
  write(channel("/a"), 0, 1000);
  const auto path = folder_.path() / "snapshot.mcap";
  writer_->snapshot(path).get();
  expect_every_number_up_to(999, 900, sequences(path));
}

TEST_F(RingFolderTest, AFullDiskCostsNothingOfASnapshotAndItIsTriedAgain) {
  open();
  const auto a = channel("/a");
  write(a, 0, 50, 1000);
  writer_->flush();
  EXPECT_EQ(writer_->status().warning, "");
  {
    const test::FileSizeLimit limit(100);
    write(a, 50, 60, 1000);
    writer_->flush();
    EXPECT_THAT(writer_->status().warning, HasSubstr(ring_.folder.string()));
  }
  write(a, 60, 90, 1000);
  writer_->flush();
  EXPECT_EQ(writer_->status().warning, "");
  EXPECT_EQ(writer_->status().error, "");
  const auto path = folder_.path() / "snapshot.mcap";
  EXPECT_EQ(writer_->snapshot(path).get(), 90U);
  expect_every_number_up_to(89, 0, sequences(path));
}

TEST_F(RingFolderTest, AFolderThatIsNoRingIsAnError) {
  EXPECT_THROW(open_file(folder_.path()), std::system_error);
}

TEST_F(RingFolderTest, DamageInItNeverHurts) {
  open();
  write(channel("/a"), 0, 300);
  const auto killed = copy();
  std::vector<std::filesystem::path> files;
  for (const auto& file : std::filesystem::directory_iterator(killed)) files.push_back(file.path());
  ASSERT_GE(files.size(), 5U);
  for (std::size_t i = 0; i < 300; ++i) {
    const auto& file = files[i % files.size()];
    const auto whole = test::content_of(*open_plain_file(file));
    auto bytes = whole;
    if (i % 3 == 0) bytes.resize(bytes.size() * (i / 3 % 10) / 10);
    if (!bytes.empty()) bytes[i * 7919 % bytes.size()] ^= std::byte{0x5A};
    const auto put = [&](const std::vector<std::byte>& content) {
      std::ofstream(file, std::ios::binary)
          .write(reinterpret_cast<const char*>(content.data()),
                 static_cast<std::streamsize>(content.size()));
    };
    put(bytes);
    std::vector<std::byte> out;
    try {
      const auto report = recover(open_ring(killed), write_to_memory(out));
      EXPECT_LE(report.messages, 300U);
      EXPECT_TRUE(Reader(open_memory(std::move(out))).summary().complete) << i;
    } catch (const FileError& error) {
      EXPECT_THAT(error.what(), HasSubstr("byte ")) << file;
    }
    put(whole);
  }
}

}  // namespace
}  // namespace coop::mcap
