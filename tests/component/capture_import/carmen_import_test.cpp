#include "capture/node/import/carmen_import.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "capture/traffic/offered_qos.hpp"
#include "capture/values/print_messages.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace coop::capture {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;

constexpr const char* kLog =
    "# comment\n"
    "PARAM robot_front_laser_max 10\n"
    "ODOM 1.0 2.0 0.5 0.3 0.1 0.0 100.5 host 0.1\n"
    "FLASER 3 1.0 2.0 10.0 1.1 2.1 0.5 1.25 2.25 0.5 101.25 host 0.2\n"
    "ODOM 9.0 9.0 0.5 0.3 0.1 0.0 101.25 host 0.3\n"
    "RLASER 3 1.0 2.0 3.0 1.1 2.1 0.5 1.5 2.5 0.5 102 host 0.4\n";

mcap::WriterOptions waiting() {
  mcap::WriterOptions options;
  options.when_full = mcap::WhenFull::kWait;
  return options;
}

class CarmenImport : public testing::Test {
 protected:
  struct Imported {
    CarmenImportReport report;
    std::vector<json> messages;
  };

  Imported imported(std::vector<carmen::Record> records, const CarmenImportOptions& options = {}) {
    const auto path = folder_.path() / "log.mcap";
    mcap::Writer writer(mcap::Series{.path = path}, waiting());
    Imported result{import_carmen(std::move(records), options, writer), {}};
    writer.close();
    mcap::Reader reader(path);
    std::stringstream text;
    EXPECT_EQ(print_messages(reader, {.format = PrintFormat::kJson}, text).undecoded, 0U);
    for (std::string line; std::getline(text, line);) result.messages.push_back(json::parse(line));
    return result;
  }

  static std::vector<carmen::Record> records_of(const std::string& text) {
    carmen::LogReader reader(std::make_unique<std::istringstream>(text), "log");
    std::vector<carmen::Record> records;
    while (auto record = reader.next()) records.push_back(std::move(*record));
    return records;
  }

  test::TemporaryFolder folder_;
};

TEST_F(CarmenImport, a_log_becomes_the_messages_of_a_robot) {
  const auto [report, messages] = imported(records_of(kLog), {.laser_in_base = {0.2, 0.0, 0.0}});
  EXPECT_EQ(report.scans, 1U);
  EXPECT_EQ(report.odometry, 3U);
  std::vector<std::string> order;
  for (const json& message : messages) order.push_back(message["topic"]);
  EXPECT_THAT(order,
              ElementsAre("/tf_static", "/odom", "/tf", "/scan", "/odom", "/tf", "/odom", "/tf"));

  const json& mount = messages[0]["data"]["transforms"][0];
  EXPECT_EQ(mount["header"]["frame_id"], "base_link");
  EXPECT_EQ(mount["child_frame_id"], "laser_link");
  EXPECT_EQ(mount["transform"]["translation"]["x"], 0.2);
  EXPECT_EQ(messages[1]["log_time"], 100.5);
  EXPECT_EQ(messages[1]["data"]["header"]["stamp"]["nanosec"], 500'000'000);
  EXPECT_EQ(messages[1]["data"]["pose"]["pose"]["position"]["y"], 2.0);
  EXPECT_EQ(messages[1]["data"]["twist"]["twist"]["linear"]["x"], 0.3);
  EXPECT_EQ(messages[2]["data"]["transforms"][0]["child_frame_id"], "base_link");
  const json& scan = messages[3]["data"];
  EXPECT_EQ(scan["header"]["frame_id"], "laser_link");
  EXPECT_EQ(scan["header"]["stamp"]["sec"], 101);
  EXPECT_THAT(scan["ranges"], ElementsAre(1.0, 2.0, "Infinity"));
  // Of two readings of one stamp the last line stands.
  EXPECT_EQ(messages[4]["data"]["pose"]["pose"]["position"]["x"], 9.0);
}

TEST_F(CarmenImport, topics_are_offered_as_a_robot_does) {
  const auto path = folder_.path() / "offered.mcap";
  mcap::Writer writer(mcap::Series{.path = path}, waiting());
  (void)import_carmen(records_of(kLog), {}, writer);
  writer.close();
  const mcap::Reader reader(path);
  for (const auto& [id, channel] : reader.summary().channels) {
    const auto offered = parse_offered_qos(channel.metadata.at("offered_qos_profiles"));
    ASSERT_EQ(offered.size(), 1U) << channel.topic;
    EXPECT_EQ(offered[0].reliable, channel.topic.starts_with("/tf")) << channel.topic;
    EXPECT_EQ(offered[0].transient_local, channel.topic == "/tf_static") << channel.topic;
  }
}

TEST_F(CarmenImport, a_log_without_measurements_is_refused) {
  EXPECT_THROW(imported(records_of("PARAM a b\n")), std::runtime_error);
}

TEST_F(CarmenImport, a_recorded_building_is_whole) {
  const auto log = test::shared_data("slam/intel.clf");
  if (!log) GTEST_SKIP() << "not run: the recorded log is not at hand";
  auto records = carmen::read_log(*log);
  const auto lasers = std::ranges::count_if(records, [](const carmen::Record& record) {
    const auto* laser = std::get_if<carmen::LaserRecord>(&record);
    return laser != nullptr && !laser->rear;
  });
  const auto path = folder_.path() / "intel.mcap";
  mcap::Writer writer(mcap::Series{.path = path}, waiting());
  const auto report = import_carmen(std::move(records), {}, writer);
  writer.close();
  EXPECT_EQ(report.scans, static_cast<std::uint64_t>(lasers));
  const auto statistics = mcap::Reader(path).summary().statistics;
  ASSERT_TRUE(statistics);
  EXPECT_EQ(statistics->message_count, report.scans + 2 * report.odometry + 1);
}

}  // namespace
}  // namespace coop::capture
