#include "capture/traffic/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "capture/mcap/reader.hpp"
#include "capture/traffic/play_list.hpp"
#include "support/temporary_folder.hpp"

namespace coop::capture {
namespace {

Time at(double s) {
  return time_from_seconds(s);
}

class Recordings : public ::testing::Test {
 protected:
  static WriterInfo writer(const std::string& topic, const std::string& component) {
    WriterInfo info;
    info.topic = topic;
    info.dds_type = "std_msgs::msg::dds_::String_";
    info.component = component;
    info.id = component + topic;
    return info;
  }
  /// A std_msgs/String with one letter.
  static std::vector<std::uint8_t> letter(char c) {
    return {0, 1, 0, 0, 2, 0, 0, 0, static_cast<std::uint8_t>(c), 0};
  }
  static std::string letters(const std::vector<PlayMessage>& messages) {
    std::string out;
    for (const PlayMessage& message : messages) out += static_cast<char>(message.bytes.at(8));
    return out;
  }
  static std::string rest_of(PlayList& list) {
    std::vector<PlayMessage> messages;
    while (auto message = list.next()) messages.push_back(std::move(*message));
    return letters(messages);
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "x.mcap"; }
  RecordingOptions options() {
    RecordingOptions options;
    options.path = path();
    return options;
  }

  test::TemporaryFolder folder_;
};

TEST_F(Recordings, HaveAChannelAWriterWithItsTypeAndWhatItOffered) {
  Recording recording(options());
  WriterInfo info = writer("/chatter", "talker");
  info.qos.transient_local = true;
  const auto channel = recording.add_channel(info);
  EXPECT_EQ(recording.add_channel(info), channel) << "the same writer again";
  EXPECT_TRUE(recording.write(channel, 1, at(1), at(2), letter('a')));
  recording.close();

  const mcap::Reader reader(path());
  ASSERT_EQ(reader.summary().channels.size(), 1U);
  const mcap::Channel& kept = reader.summary().channels.begin()->second;
  EXPECT_EQ(kept.topic, "/chatter");
  EXPECT_EQ(kept.message_encoding, "cdr");
  EXPECT_EQ(kept.metadata.at("component"), "talker");
  EXPECT_TRUE(parse_offered_qos(kept.metadata.at("offered_qos_profiles")).at(0).transient_local);
  const mcap::Schema* schema = reader.summary().schema_of(kept);
  ASSERT_NE(schema, nullptr);
  EXPECT_EQ(schema->name, "std_msgs/msg/String");
  EXPECT_EQ(schema->encoding, "ros2msg");
  EXPECT_THAT(schema->data, ::testing::HasSubstr("string data"));
}

TEST_F(Recordings, KeepTypesThatNobodyKnowsByName) {
  Recording recording(options());
  WriterInfo info = writer("strange", "device");
  info.dds_type = "Strange";
  recording.write(recording.add_channel(info), 1, at(1), at(1), {{0, 1, 0, 0, 7}});
  recording.close();
  const mcap::Reader reader(path());
  const mcap::Schema* schema =
      reader.summary().schema_of(reader.summary().channels.begin()->second);
  ASSERT_NE(schema, nullptr);
  EXPECT_EQ(schema->name, "Strange");
  EXPECT_EQ(schema->encoding, "");
}

TEST_F(Recordings, TellWhatIsMissingByTopic) {
  Recording recording(options());
  const auto channel = recording.add_channel(writer("/scan", "lidar"));
  const auto other = recording.add_channel(writer("/scan", "lidar_2"));
  for (const std::uint64_t sequence : {5U, 6U, 9U, 10U}) {
    recording.write(channel, sequence, at(1), at(1), letter('a'));
  }
  recording.write(other, 1, at(1), at(1), letter('a'));
  const auto report = recording.report();
  ASSERT_EQ(report.size(), 1U);
  EXPECT_EQ(report[0].messages, 5U);
  EXPECT_EQ(report[0].missed, 2U);
  EXPECT_EQ(losses_text(report), "2 missed of /scan");
  recording.close();
  const mcap::Reader reader(path());
  ASSERT_FALSE(reader.summary().metadata.empty());
  EXPECT_EQ(reader.metadata(reader.summary().metadata.back()).metadata.at("/scan missed"), "2");
}

TEST_F(Recordings, ARingKeepsTheLastAndIsWrittenOnDemand) {
  RecordingOptions ring = options();
  ring.last = std::chrono::seconds(10);
  ring.writer.chunk_bytes = 1024;  // a chunk a second in no time: all of them have room
  Recording recording(ring);
  const auto channel = recording.add_channel(writer("/chatter", "talker"));
  for (std::uint64_t i = 1; i <= 100; ++i) {
    recording.write(channel, i, at(static_cast<double>(i)), at(0), letter('a'));
  }
  EXPECT_FALSE(std::filesystem::exists(path()));
  const std::uint64_t messages = recording.save(path()).get();
  EXPECT_GE(messages, 10U);
  EXPECT_LE(messages, 14U);
  const mcap::Reader reader(path());
  EXPECT_EQ(reader.summary().statistics->message_count, messages);
  EXPECT_EQ(reader.summary().statistics->message_end_time, 100'000'000'000U);
}

TEST_F(Recordings, ArePlayedInTheOrderOfTheirLogTimesWithoutSomeComponents) {
  Recording recording(options());
  const auto lidar = recording.add_channel(writer("/scan", "lidar"));
  const auto amcl = recording.add_channel(writer("/pose", "amcl"));
  const auto beat = recording.add_channel(writer("/component_status", "amcl"));
  recording.write(lidar, 1, at(10), at(1), letter('a'));
  recording.write(amcl, 1, at(11), at(1), letter('b'));
  recording.write(beat, 1, at(11), at(1), letter('x'));
  recording.write(lidar, 2, at(12), at(1), letter('c'));
  recording.close();
  PlayList all(path(), {});
  EXPECT_EQ(rest_of(all), "abc") << "heartbeats belong to the run";
  all.rewind();
  EXPECT_EQ(rest_of(all), "abc");
  PlayList some(path(), {.topics = {}, .without = {"amcl"}, .remap = {"scan:=laser"}});
  EXPECT_EQ(rest_of(some), "ac");
  ASSERT_EQ(some.channels().size(), 1U);
  EXPECT_EQ(some.channels()[0].topic, "/laser");
  EXPECT_EQ(some.channels()[0].recorded_topic, "/scan");
}

TEST_F(Recordings, FromALaterStartHaveTheLatchedMessagesOfBefore) {
  Recording recording(options());
  WriterInfo map = writer("/map", "slam");
  map.qos.transient_local = true;
  const auto latched = recording.add_channel(map);
  const auto scan = recording.add_channel(writer("/scan", "lidar"));
  recording.write(latched, 1, at(0), at(0), letter('a'));
  recording.write(latched, 2, at(1), at(0), letter('b'));
  recording.write(scan, 1, at(2), at(0), letter('c'));
  recording.write(scan, 2, at(6), at(0), letter('d'));
  recording.write(latched, 3, at(7), at(0), letter('e'));
  recording.write(scan, 3, at(9), at(0), letter('f'));
  recording.close();
  PlayList list(path(), {.topics = {}, .start = 5.0, .duration = 3.0});
  EXPECT_EQ(letters(list.latched_before()), "b");
  EXPECT_EQ(rest_of(list), "de");
}

TEST_F(Recordings, NonsenseIsRefusedInOneLine) {
  Recording recording(options());
  recording.write(recording.add_channel(writer("/scan", "lidar")), 1, at(1), at(1), letter('a'));
  recording.close();
  EXPECT_THROW(PlayList(path(), {.topics = {{"nothing"}, {}}}), std::invalid_argument);
  EXPECT_THROW(PlayList(path(), {.topics = {}, .start = 60.0}), std::invalid_argument);
  EXPECT_THROW(PlayList(path(), {.topics = {}, .remap = {"scan"}}), std::invalid_argument);
  EXPECT_THROW(PlayList(folder_.path() / "none", {}), std::exception);
}

TEST_F(Recordings, GoOnInANewFileWhenTheClockWasSetBack) {
  Recording recording(options());
  WriterInfo map = writer("/map", "amcl");
  map.qos.transient_local = true;
  const auto latched = recording.add_channel(map);
  const auto stream = recording.add_channel(writer("/scan", "lidar"));
  recording.write(latched, 1, at(100), at(1), letter('m'));
  recording.write(stream, 1, at(101), at(2), letter('a'));
  recording.begin_anew(folder_.path() / "y.mcap");
  recording.write(stream, 2, at(3), at(3), letter('b'));
  recording.write(stream, 3, at(4), at(4), letter('c'));
  recording.close();
  EXPECT_EQ(recording.report()[1].missed, 0U);
  PlayList before(path(), {});
  EXPECT_EQ(rest_of(before), "ma");
  EXPECT_EQ(before.end(), at(101));
  PlayList after(folder_.path() / "y.mcap", {});
  EXPECT_EQ(after.begin(), at(3));
  EXPECT_EQ(letters(after.all_of("/map")), "m") << "a late reader would have got it";
  EXPECT_FALSE(after.was_cut());
  EXPECT_TRUE(mcap::Reader(path()).summary().complete);
}

TEST_F(Recordings, ARingTellsTheLastWordsThatAreOlderThanItself) {
  RecordingOptions ring = options();
  ring.last = std::chrono::seconds(10);
  ring.writer.chunk_age = 1'000'000'000;
  Recording recording(ring);
  WriterInfo map = writer("/map", "amcl");
  map.qos.transient_local = true;
  const auto old = recording.add_channel(map);
  recording.write(old, 1, at(0.5), at(0.5), letter('o'));
  map.id = "its successor";
  const auto latched = recording.add_channel(map);
  const auto stream = recording.add_channel(writer("/scan", "lidar"));
  recording.write(latched, 1, at(1), at(1), letter('m'));
  for (int i = 2; i < 40; ++i) {
    recording.write(stream, static_cast<std::uint64_t>(i), at(i), at(i), letter('s'));
  }
  EXPECT_GT(recording.save(path()).get(), 9U);
  PlayList saved(path(), {});
  EXPECT_GE(saved.begin(), at(28)) << "nothing is older than the ring";
  EXPECT_EQ(letters(saved.all_of("/map")), "m");
  // A second one tells it as well, and no more often.
  EXPECT_GT(recording.save(folder_.path() / "y.mcap").get(), 9U);
  PlayList again(folder_.path() / "y.mcap", {});
  EXPECT_EQ(letters(again.all_of("/map")), "m");
}

TEST_F(Recordings, ARingForgetsAnotherTime) {
  RecordingOptions ring = options();
  ring.last = std::chrono::seconds(10);
  Recording recording(ring);
  const auto stream = recording.add_channel(writer("/scan", "lidar"));
  for (int i = 0; i < 20; ++i) {
    recording.write(stream, static_cast<std::uint64_t>(i), at(100 + i), at(i), letter('a'));
  }
  recording.begin_anew(path());
  for (int i = 0; i < 5; ++i) {
    recording.write(stream, static_cast<std::uint64_t>(20 + i), at(1 + i), at(i), letter('b'));
  }
  EXPECT_EQ(recording.save(path()).get(), 5U);
  PlayList saved(path(), {});
  EXPECT_EQ(rest_of(saved), "bbbbb");
}

TEST_F(Recordings, ARingThatOutlivesItsRecorderBeginsWithTheLastWordsFromBeforeIt) {
  RecordingOptions ring = options();
  ring.last = std::chrono::seconds(10);
  ring.rings = folder_.path();
  ring.writer.chunk_bytes = 1024;
  Recording recording(ring);
  WriterInfo info = writer("/map", "amcl");
  info.qos.transient_local = true;
  recording.write(recording.add_channel(info), 1, at(1), at(1), letter('m'));
  const auto chatter = recording.add_channel(writer("/chatter", "talker"));
  for (std::uint64_t i = 2; i <= 100; ++i) {
    recording.write(chatter, i, at(static_cast<double>(i)), at(0), letter('a'));
  }
  const auto folder = folder_.path() / ("coop-ring-x-" + std::to_string(::getpid()));
  // Its thread is behind at first, and files go while they are read.
  std::optional<mcap::Reader> killed;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < deadline) {
    try {
      killed.emplace(folder);
      const auto& statistics = *killed->summary().statistics;
      if (statistics.message_end_time == 100'000'000'000U &&
          statistics.message_start_time > 85'000'000'000U) {
        break;
      }
    } catch (const std::exception&) {
      std::this_thread::yield();
    }
  }
  ASSERT_TRUE(killed);
  auto messages = killed->messages({.order = mcap::Order::kFile});
  const auto first = messages.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->channel->topic, "/map");
  EXPECT_GT(first->message.log_time, 85'000'000'000U) << "not when it was said";
  EXPECT_EQ(first->message.publish_time, 1'000'000'000U);
  recording.close();
  EXPECT_FALSE(std::filesystem::exists(folder)) << "nothing is left of one that is closed";
}

}  // namespace
}  // namespace coop::capture
