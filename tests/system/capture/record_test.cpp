// The recorder as part of a running system.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <map>

#include "capture/mcap/reader.hpp"
#include "coop_msgs/msg/EmergencyStop.h"
#include "nav_msgs/msg/OccupancyGrid.h"
#include "rosgraph_msgs/msg/Clock.h"
#include "system/capture/capture_support.hpp"
#include "system/support/listener.hpp"

namespace coop::test {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Key;

/// Messages by topic and writer.
std::map<std::string, std::uint64_t> counts(const mcap::Summary& summary) {
  std::map<std::string, std::uint64_t> found;
  for (const auto& [id, channel] : summary.channels) {
    const auto count = summary.statistics->channel_message_counts.find(id);
    found[channel.topic + " of " + channel.metadata.at("component")] +=
        count == summary.statistics->channel_message_counts.end() ? 0 : count->second;
  }
  return found;
}

/// No writer's numbers have a hole, on topics where none may be lost.
void expect_no_holes(const std::filesystem::path& file) {
  mcap::Reader reader(file);
  std::map<std::uint16_t, std::uint32_t> last;
  auto cursor = reader.messages({.topics = {"/clock", "/tf", "/imu"}, .order = mcap::Order::kFile});
  while (const auto message = cursor.next()) {
    auto& before = last[message->message.channel_id];
    if (before != 0) {
      EXPECT_EQ(message->message.sequence, before + 1) << message->channel->topic;
    }
    before = message->message.sequence;
  }
  EXPECT_FALSE(last.empty());
}

/// The simulated time of a system. It has a heartbeat like any program: the recorder would take its
/// end for a death, so it is to live as long as the test.
class SimulatedTime {
 public:
  explicit SimulatedTime(const RunningSystem& system) : listener_(system.domain(), "watch") {
    listener_.node().subscribe<rosgraph_msgs::msg::Clock>(
        "clock", runtime::Qos::kEvent, [this](const rosgraph_msgs::msg::Clock& message) {
          now_ = message.clock().sec() + 1e-9 * message.clock().nanosec();
        });
  }
  /// Until so much of it has passed.
  bool pass(double seconds) {
    double begun = 0.0;
    return wait_until([&] {
      listener_.look();
      if (begun == 0.0) begun = now_;
      return now_ - begun >= seconds;
    });
  }

 private:
  Listener listener_;
  double now_ = 0.0;
};

TEST(Record, ASystemsCaptureIsCompleteWhenItIsStopped) {
  const LaunchText launch(kSmallSystem);
  RunningSystem system(launch.path());
  SimulatedTime time(system);
  ASSERT_TRUE(system.wait_for_state("lidar_driver", "ready")) << system.launcher().output();
  ASSERT_TRUE(time.pass(3.0));
  const auto run = system.run_folder();
  system.launcher().signal(SIGINT);
  ASSERT_TRUE(system.launcher().wait());
  const auto files = captures_of(run);
  ASSERT_EQ(files.size(), 1U);

  const mcap::Reader reader(files[0]);
  const mcap::Summary& summary = reader.summary();
  EXPECT_TRUE(summary.complete) << summary.defect;
  EXPECT_EQ(summary.header.profile, "ros2");
  for (const auto& [id, channel] : summary.channels) {
    const mcap::Schema* schema = summary.schema_of(channel);
    ASSERT_NE(schema, nullptr) << channel.topic;
    EXPECT_EQ(schema->encoding, "ros2msg") << channel.topic;
    EXPECT_FALSE(schema->data.empty()) << channel.topic;
  }
  const auto found = counts(summary);
  for (const char* topic :
       {"/clock of simulator", "/tf of simulator", "/odom of simulator", "/imu of simulator",
        "/tf_static of simulator", "/tf_static of lidar_driver", "/ground_truth of simulator",
        "/world of simulator", "/scan of lidar_driver", "/map of amcl",
        "/component_status of simulator", "/component_status of record"}) {
    EXPECT_THAT(found, Contains(Key(topic)));
    EXPECT_GT(found.count(topic) == 0 ? 0 : found.at(topic), 0U) << topic;
  }
  EXPECT_GE(found.at("/clock of simulator"), 300U);
  expect_no_holes(files[0]);
  std::vector<std::string> attached;
  for (const auto& attachment : summary.attachments) attached.push_back(attachment.name);
  EXPECT_THAT(attached,
              ::testing::IsSupersetOf({"launch.yaml", "amcl.yaml", "duck_house.world.yaml",
                                       "egg_collector.urdf", "duck_house_survey.yaml"}));
  // Log times are simulated: some seconds, not those of the wall.
  EXPECT_LT(summary.statistics->message_end_time - summary.statistics->message_start_time,
            100'000'000'000U);
}

TEST(Record, KilledInMidRunItIsStartedAgainAndBothFilesCanBeRead) {
  const LaunchText launch(kSmallSystem);
  RunningSystem system(launch.path());
  SimulatedTime time(system);
  ASSERT_TRUE(system.wait_for_state("lidar_driver", "ready")) << system.launcher().output();
  ASSERT_TRUE(time.pass(2.0));
  system.kill_component("record");
  ASSERT_TRUE(system.wait_for([](const launcher::SystemView& view) {
    return std::ranges::any_of(view.rows, [](const launcher::Row& row) {
      return row.name == "record" && row.state == "ready" && row.restarts > 0;
    });
  }));
  ASSERT_TRUE(time.pass(2.0));
  const auto run = system.run_folder();
  system.launcher().signal(SIGINT);
  ASSERT_TRUE(system.launcher().wait());
  const auto files = captures_of(run);
  ASSERT_EQ(files.size(), 2U);
  const mcap::Reader cut(files[0]);
  EXPECT_FALSE(cut.summary().complete);
  ASSERT_TRUE(cut.summary().statistics);
  EXPECT_GT(cut.summary().statistics->message_count, 100U);
  EXPECT_TRUE(std::filesystem::exists(files[0].string() + ".tail"));
  expect_no_holes(files[0]);
  const mcap::Reader second(files[1]);
  EXPECT_TRUE(second.summary().complete);
  // The late joiner got what is latched.
  EXPECT_GE(counts(second.summary()).at("/map of amcl"), 1U);
  EXPECT_GE(counts(second.summary()).at("/tf_static of simulator"), 1U);
  expect_no_holes(files[1]);
}

TEST(Record, TheRingIsWrittenWhenAComponentDiesAndWhenAskedFor) {
  std::string text = kSmallSystem;
  text.replace(text.find("chunk_age: 0.5"), 14, "chunk_age: 0.5, last: 60, save_delay: 0.5");
  const LaunchText launch(text);
  RunningSystem system(launch.path());
  SimulatedTime time(system);
  ASSERT_TRUE(system.wait_for_state("lidar_driver", "ready")) << system.launcher().output();
  ASSERT_TRUE(time.pass(1.0));
  const auto run = system.run_folder();
  EXPECT_THAT(captures_of(run), IsEmpty());

  const std::vector<std::string> snapshot{"snapshot", "a look", "--domain",
                                          std::to_string(system.domain())};
  Program first("topic", snapshot, system.folder() / "snapshot");
  const auto status = first.wait();
  ASSERT_TRUE(status && status->code == 0) << first.output();
  ASSERT_EQ(captures_of(run).size(), 1U);
  const mcap::Reader asked_for(captures_of(run)[0]);
  EXPECT_TRUE(asked_for.summary().complete);
  EXPECT_GT(asked_for.summary().statistics->message_count, 100U);

  system.kill_component("lidar_driver");
  ASSERT_TRUE(wait_until([&] { return captures_of(run).size() == 2U; }));
  system.launcher().signal(SIGINT);
  ASSERT_TRUE(system.launcher().wait());
  const mcap::Reader fault(captures_of(run)[1]);
  EXPECT_TRUE(fault.summary().complete) << fault.summary().defect;
  EXPECT_THAT(counts(fault.summary()), Contains(Key("/scan of lidar_driver")));
}

TEST(Record, KilledItsRingBecomesACaptureOfTheTimeBefore) {
  const TemporaryFolder rings;
  std::string text = kSmallSystem;
  text.replace(text.find("chunk_age: 0.5"), 14,
               "chunk_age: 0.5, last: 60, ring_folder: " + rings.path().string());
  const LaunchText launch(text);
  RunningSystem system(launch.path());
  SimulatedTime time(system);
  ASSERT_TRUE(system.wait_for_state("lidar_driver", "ready")) << system.launcher().output();
  ASSERT_TRUE(time.pass(2.0));
  const auto run = system.run_folder();
  EXPECT_THAT(captures_of(run), IsEmpty());
  system.kill_component("record");
  ASSERT_TRUE(wait_until([&] { return captures_of(run).size() == 1U; }));
  const auto file = captures_of(run)[0];
  EXPECT_THAT(file.stem().string(), ::testing::EndsWith("-killed"));
  const mcap::Reader before(file);
  EXPECT_TRUE(before.summary().complete);
  const auto found = counts(before.summary());
  EXPECT_GE(found.at("/clock of simulator"), 200U);
  EXPECT_GE(found.at("/map of amcl"), 1U);
  EXPECT_GE(found.at("/tf_static of simulator"), 1U);
  EXPECT_GT(before.summary().attachments.size(), 3U);
  expect_no_holes(file);
  system.launcher().signal(SIGINT);
  ASSERT_TRUE(system.launcher().wait());
  EXPECT_TRUE(std::filesystem::is_empty(rings.path())) << "a ring that is closed leaves nothing";
}

}  // namespace
}  // namespace coop::test
