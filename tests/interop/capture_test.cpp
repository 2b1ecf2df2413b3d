// Captures of ours in the hands of others: the readers of the npm packages @mcap/core,
// @foxglove/rosmsg and
// @foxglove/rosmsg2-serialization find the same messages, definitions and values as we do.
#include <gtest/gtest.h>

#include <fstream>
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

}  // namespace
}  // namespace coop::test
