// Captures of ours in the hands of others: the readers of the npm packages @mcap/core,
// @foxglove/rosmsg and
// @foxglove/rosmsg2-serialization find the same messages, definitions and values as we do.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "capture/mcap/writer.hpp"
#include "capture/schema/definitions.hpp"
#include "capture/values/print_messages.hpp"
#include "core/atomic_file.hpp"
#include "support/shared_data.hpp"
#include "system/support/running_system.hpp"
#include "unit/idl/cdr_sample.hpp"

namespace coop::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr int kNotRun = 77;
constexpr std::uint32_t kMessagesOfAType = 5;

class CaptureInOtherHands : public testing::Test {
 protected:
  /// What the others say of a capture and our values of it; nothing where they are not there.
  std::optional<json> checked(const fs::path& capture) {
    const fs::path values = folder_.path() / "values.jsonl";
    std::ofstream out(values, std::ios::binary);
    mcap::Reader reader(capture);
    const auto report =
        capture::print_messages(reader, {.format = capture::PrintFormat::kJson}, out);
    EXPECT_EQ(report.undecoded, 0U);
    Program script(COOP_SOURCE_DIR "/tests/interop/npm/check_capture.sh",
                   {COOP_NPM_FOLDER, capture.string(), values.string()}, folder_.path() / "report");
    const auto status = script.wait(std::chrono::seconds(200));
    if (!status) throw std::runtime_error("the readers of npm did not end");
    if (status->code == kNotRun) {
      why_ = script.output();
      return std::nullopt;
    }
    const std::string output = script.output();
    if (!json::accept(output)) throw std::runtime_error(output);
    return json::parse(output);
  }

  static void expect_no_difference(const json& report, std::size_t topics, std::uint64_t messages) {
    EXPECT_EQ(report["differences"], json::array());
    EXPECT_EQ(report["topics"].size(), topics);
    EXPECT_EQ(report["messages"], messages);
    EXPECT_EQ(report["profile"], "ros2");
    EXPECT_GT(report["compared"], messages);
  }

  /// Part of a capture, by the options of `mcap filter`.
  fs::path part_of(const fs::path& capture, const std::string& name,
                   const std::vector<std::string>& options) {
    const fs::path part = folder_.path() / (name + ".mcap");
    std::vector<std::string> arguments{"filter", capture.string(), "-o", part.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    Program filter(COOP_BIN_DIR "/mcap", arguments, folder_.path() / "filter");
    const auto status = filter.wait();
    EXPECT_TRUE(status && status->clean()) << filter.output();
    return part;
  }

  TemporaryFolder folder_;
  std::string why_;
};

/// Random messages of every type, in one file.
std::uint64_t write_every_type(const fs::path& path, mcap::Compression compression) {
  const Schema schema = load_idl(fs::path(COOP_SOURCE_DIR) / "idl");
  mcap::WriterOptions options;
  options.compression = compression;
  options.when_full = mcap::WhenFull::kWait;
  mcap::Writer writer(mcap::Series{.path = path}, options);
  std::uint64_t written = 0;
  for (const std::string_view name : capture::ros2msg_names()) {
    const auto id = writer.add_schema(name, "ros2msg", *capture::ros2msg_definition(name));
    const auto channel = writer.add_channel(id, "/" + std::string(name));
    for (std::uint32_t i = 0; i < kMessagesOfAType; ++i) {
      const Bytes bytes = CdrSample(schema, i + 1)(capture::short_type_name(name));
      EXPECT_TRUE(writer.write({.channel_id = channel,
                                .sequence = i,
                                .log_time = 1'700'000'000'000'000'000 + written,
                                .publish_time = written,
                                .data = std::as_bytes(std::span(bytes))}));
      ++written;
    }
  }
  writer.close();
  EXPECT_EQ(writer.status().error, "");
  return written;
}

TEST_F(CaptureInOtherHands, every_type_has_a_definition_they_read_and_the_same_values) {
  for (const auto compression :
       {mcap::Compression::kNone, mcap::Compression::kZstd, mcap::Compression::kLz4}) {
    const fs::path capture = folder_.path() / "every_type.mcap";
    const std::uint64_t written = write_every_type(capture, compression);
    const auto report = checked(capture);
    if (!report) GTEST_SKIP() << "not run: " << why_;
    expect_no_difference(*report, capture::ros2msg_names().size(), written);
    for (const auto& topic : (*report)["topics"]) EXPECT_EQ(topic["messages"], kMessagesOfAType);
  }
}

TEST_F(CaptureInOtherHands, the_recorded_bag_has_the_values_they_find) {
  const auto bag = shared_data("ros2/bags/macfirst_floor_take_2");
  if (!bag) GTEST_SKIP() << "not run: the recorded bag is not at hand";
  const fs::path capture = folder_.path() / "bag.mcap";
  Program import(COOP_BIN_DIR "/mcap", {"import", bag->string(), "-o", capture.string()},
                 folder_.path() / "import");
  const auto status = import.wait();
  ASSERT_TRUE(status && status->clean()) << import.output();
  const auto report = checked(capture);
  if (!report) GTEST_SKIP() << "not run: " << why_;
  expect_no_difference(*report, 6, 2425);
  EXPECT_EQ((*report)["topics"]["/scan"]["messages"], 357);
  EXPECT_EQ((*report)["topics"]["/odom"]["messages"], 920);
  EXPECT_EQ((*report)["topics"]["/tf"]["messages"], 953);
}

/// Topics that have messages, and how many, as we count them.
std::map<std::string, std::uint64_t> counts_of(const fs::path& capture) {
  const mcap::Reader reader(capture);
  EXPECT_TRUE(reader.summary().complete) << reader.summary().defect;
  std::map<std::string, std::uint64_t> counts;
  const auto& by_channel = reader.summary().statistics->channel_message_counts;
  for (const auto& [id, channel] : reader.summary().channels) {
    const auto found = by_channel.find(id);
    if (found != by_channel.end() && found->second > 0) counts[channel.topic] += found->second;
  }
  return counts;
}

void expect_their_counts(const json& report, const fs::path& capture) {
  std::uint64_t all = 0;
  const auto counts = counts_of(capture);
  for (const auto& [topic, count] : counts) {
    all += count;
    ASSERT_TRUE(report["topics"].contains(topic)) << topic;
    EXPECT_EQ(report["topics"][topic]["messages"], count) << topic;
  }
  EXPECT_EQ(report["differences"], json::array());
  EXPECT_EQ(report["topics"].size(), counts.size());
  EXPECT_EQ(report["messages"], all);
}

TEST_F(CaptureInOtherHands, a_mission_of_the_whole_robot_has_every_topic_with_its_values) {
  const fs::path launch = fs::path(COOP_SOURCE_DIR) / "config/launch/collect.yaml";
  RunningSystem system(launch, {"--until", "mission-done", "--set", "lockstep=true", "--set",
                                "rate=0", "--set", "record.last=0", "--set", "record.exclude=[]",
                                "--set", "world=" COOP_SOURCE_DIR "/tests/data/two_eggs.world.yaml",
                                "--set", "sequencer.mission.expected_eggs=2"});
  const auto status = system.launcher().wait(std::chrono::minutes(5));
  ASSERT_TRUE(status && status->clean()) << system.launcher().output();
  const fs::path folder = system.folder() / "runs/latest/captures";
  ASSERT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  const fs::path capture = fs::directory_iterator(folder)->path();
  const auto recorded = counts_of(capture);
  for (const char* topic : {"/clock",
                            "/tf",
                            "/tf_static",
                            "/odom",
                            "/imu",
                            "/scan",
                            "/map",
                            "/amcl_pose",
                            "/particle_cloud",
                            "/camera/image",
                            "/camera/depth",
                            "/camera/camera_info",
                            "/eggs",
                            "/goal_pose",
                            "/plan",
                            "/global_costmap",
                            "/local_plan",
                            "/local_costmap",
                            "/dwa_candidates",
                            "/cmd_vel",
                            "/navigation_status",
                            "/pick",
                            "/pick_result",
                            "/joint_states",
                            "/mission_status",
                            "/component_status",
                            "/ground_truth",
                            "/world"}) {
    EXPECT_TRUE(recorded.contains(topic)) << topic;
  }
  // Pictures are many numbers: a second of them, and the whole mission of everything else.
  const fs::path words = part_of(capture, "words", {"--exclude", "/camera/image", "/camera/depth"});
  const auto report = checked(words);
  if (!report) GTEST_SKIP() << "not run: " << why_;
  expect_their_counts(*report, words);
  EXPECT_EQ((*report)["topics"].size() + 2, recorded.size());
  const fs::path second = part_of(capture, "second", {"--start", "20", "--end", "21"});
  const auto pictures = checked(second);
  ASSERT_TRUE(pictures);
  expect_their_counts(*pictures, second);
  EXPECT_GE((*pictures)["topics"]["/camera/image"]["messages"], 4);
  EXPECT_GE((*pictures)["topics"]["/camera/depth"]["messages"], 4);
}

}  // namespace
}  // namespace coop::test
