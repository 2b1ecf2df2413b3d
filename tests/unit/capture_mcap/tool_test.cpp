#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/mcap_tool/attachments.hpp"
#include "capture/mcap_tool/copy.hpp"
#include "capture/mcap_tool/info.hpp"
#include "capture/mcap_tool/rosbag2.hpp"
#include "core/atomic_file.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"
#include "unit/capture_mcap/capture.hpp"

namespace coop::mcap {
namespace {

using coop::test::TemporaryFolder;
using test::bytes_of;
using test::lines_of;
using test::SmallFile;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

WriterOptions copying() {
  WriterOptions options;
  options.when_full = WhenFull::kWait;
  return options;
}

TEST(SafeFileName, IsNeverAPath) {
  EXPECT_EQ(safe_file_name("map.yaml"), "map.yaml");
  EXPECT_EQ(safe_file_name("../../etc/passwd"), "_._.._etc_passwd");
  EXPECT_EQ(safe_file_name("/etc/passwd"), "_etc_passwd");
  EXPECT_EQ(safe_file_name("a\\b\nc"), "a_b_c");
  EXPECT_EQ(safe_file_name(".."), "_.");
  EXPECT_EQ(safe_file_name(""), "unnamed");
  EXPECT_EQ(safe_file_name(std::string(5000, 'x')).size(), 200U);
}

TEST(ExtractAttachments, StayInTheirFolderAndOverwriteNothing) {
  const TemporaryFolder folder;
  SmallFile file;
  const std::string one = "one";
  const std::string two = "two";
  file.writer().add(Attachment{0, 0, "../escaped", "text/plain", bytes_of(one)});
  file.writer().add(Attachment{0, 0, "same", "text/plain", bytes_of(one)});
  file.writer().add(Attachment{0, 0, "same", "text/plain", bytes_of(two)});
  const Reader reader(open_memory(file.finish()));
  const auto inner = folder.path() / "inner";
  EXPECT_THAT(extract_attachments(reader, {}, inner),
              ElementsAre(inner / "_._escaped", inner / "same", inner / "2_same"));
  EXPECT_EQ(read_file(inner / "2_same"), two);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "escaped"));
  EXPECT_THAT(extract_attachments(reader, {"../escaped"}, inner), SizeIs(1));
  EXPECT_THAT([&] { extract_attachments(reader, {"absent"}, inner); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("no attachment 'absent'")));
}

TEST(Merge, GoesByTimeAndKeepsOneOfWhatIsTheSame) {
  const TemporaryFolder folder;
  std::vector<Reader> readers;
  readers.emplace_back(open_memory(SmallFile().message(1, 1, "p").message(2, 5, "q").finish()));
  readers.emplace_back(
      open_memory(SmallFile(Compression::kLz4).message(1, 3, "r").message(1, 5, "s").finish()));
  const auto path = folder.path() / "both.mcap";
  {
    Writer writer(Series{path}, copying());
    merge(readers, writer);
  }
  Reader both(path);
  EXPECT_THAT(lines_of(both), ElementsAre("/a 1 p", "/a 3 r", "/b 5 q", "/a 5 s"));
  EXPECT_THAT(both.summary().channels, SizeIs(2));
  EXPECT_THAT(both.summary().schemas, SizeIs(1));
}

TEST(CopySelected, TakesAttachmentsAndMetadataAlong) {
  const TemporaryFolder folder;
  SmallFile file;
  const std::string map = "the map";
  file.writer().add(Attachment{7, 8, "map.yaml", "text/yaml", bytes_of(map)});
  file.writer().add(Metadata{"versions", {{"coop", "0.1.0"}}});
  Reader reader(
      open_memory(file.message(1, 1, "p").message(2, 2, "q").message(1, 3, "r").finish()));
  const auto path = folder.path() / "part.mcap";
  {
    Writer writer(Series{path}, copying());
    copy_selected(reader, {.start = 2, .topics = {"/a"}}, writer);
  }
  Reader part(path);
  EXPECT_THAT(lines_of(part), ElementsAre("/a 3 r"));
  EXPECT_THAT(part.summary().attachments, SizeIs(1));
  EXPECT_EQ(part.summary().attachments[0].create_time, 8U);
  EXPECT_THAT(part.summary().metadata, SizeIs(1));
}

TEST(Info, TellsTimesCountsRatesAndSizes) {
  SmallFile file(Compression::kZstd);
  constexpr Nanoseconds kStart = 1'663'967'375'548'411'329;
  for (Nanoseconds i = 0; i <= 20; ++i) {
    file.message(1, kStart + i * 100'000'000, std::string(1000, 'x'));
  }
  file.message(2, kStart, "once");
  const std::string map = "the map";
  file.writer().add(Attachment{7, 8, "map.yaml", "text/yaml", bytes_of(map)});
  EXPECT_THAT(info_text(Reader(open_memory(file.finish(), "run.mcap"))),
              AllOf(HasSubstr("run.mcap"), HasSubstr("2022-09-23 21:09:35.548411329 UTC"),
                    HasSubstr("duration     2.000 s"), HasSubstr("messages     22"),
                    HasSubstr("chunks       1 zstd"), HasSubstr("/a            21      10.00"),
                    HasSubstr("std_msgs/msg/String (ros2msg)"), HasSubstr("map.yaml")));
}

TEST(Info, TellsThatAFileIsIncomplete) {
  SmallFile file;
  file.message(1, 5, "x").end_chunk();
  EXPECT_THAT(info_text(Reader(open_memory(file.bytes()))),
              AllOf(HasSubstr("INCOMPLETE"), HasSubstr("0.000000005 s")));
}

TEST(SizeText, HasThreeDigitsOrFour) {
  EXPECT_EQ(size_text(999), "999 B");
  EXPECT_EQ(size_text(1000), "1.0 kB");
  EXPECT_EQ(size_text(10'000'000'000), "10.0 GB");
  EXPECT_EQ(size_text(999'960), "1.0 MB");
}

std::optional<std::string> one_definition(std::string_view type) {
  if (type == "sensor_msgs/msg/LaserScan") return "std_msgs/Header header\n";
  return std::nullopt;
}

TEST(ImportRosbag2, ARecordingBecomesACapture) {
  const auto bag = coop::test::shared_data("ros2/bags/macfirst_floor_take_2");
  if (!bag) GTEST_SKIP() << "not run: the recorded bag is absent";
  const TemporaryFolder folder;
  const auto path = folder.path() / "bag.mcap";
  ImportReport report;
  {
    Writer writer(Series{path}, copying());
    report = import_rosbag2(*bag, one_definition, writer);
  }
  EXPECT_EQ(report.messages, 2425U);
  EXPECT_THAT(report.unknown_types, testing::Contains("tf2_msgs/msg/TFMessage"));
  Reader reader(path);
  const Summary& summary = reader.summary();
  // As metadata.yaml of the recording has it.
  EXPECT_EQ(summary.statistics->message_count, 2425U);
  EXPECT_EQ(summary.statistics->message_start_time, 1663967375548411329U);
  EXPECT_EQ(summary.statistics->message_end_time - summary.statistics->message_start_time,
            46202568732U);
  std::map<std::string, std::uint64_t> counts;
  for (const auto& [id, channel] : summary.channels) {
    counts[channel.topic] = summary.statistics->channel_message_counts.at(id);
    EXPECT_EQ(channel.message_encoding, "cdr");
    if (channel.topic == "/scan") {
      EXPECT_EQ(summary.schema_of(channel)->data, "std_msgs/Header header\n");
      EXPECT_THAT(channel.metadata.at("offered_qos_profiles"), HasSubstr("reliability: 1"));
    }
  }
  EXPECT_THAT(counts,
              ElementsAre(testing::Pair("/cmd_vel", 192), testing::Pair("/odom", 920),
                          testing::Pair("/robot_description", 1), testing::Pair("/scan", 357),
                          testing::Pair("/tf", 953), testing::Pair("/tf_static", 2)));
  EXPECT_EQ(lines_of(reader, {.topics = {"/scan"}}).size(), 357U);
}

TEST(ImportRosbag2, WhatIsNoRecordingIsAnErrorThatNamesIt) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "a.db3", std::string(5000, 'x'));
  Writer writer(Series{folder.path() / "out.mcap"}, copying());
  EXPECT_THAT([&] { static_cast<void>(import_rosbag2(folder.path(), one_definition, writer)); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("a.db3: ")));
  EXPECT_THROW(
      static_cast<void>(import_rosbag2(folder.path() / "none.db3", one_definition, writer)),
      std::runtime_error);
}

}  // namespace
}  // namespace coop::mcap
