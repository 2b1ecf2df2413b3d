// Samples that real ROS 2 nodes wrote: read with our types and written again, they give the same
// bytes.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "nav_msgs/msg/OdometryPubSubTypes.h"
#include "sensor_msgs/msg/LaserScanPubSubTypes.h"
#include "std_msgs/msg/StringPubSubTypes.h"
#include "support/shared_data.hpp"
#include "tf2_msgs/msg/TFMessagePubSubTypes.h"
#include "unit/idl/topic_type.hpp"

namespace coop::test {
namespace {

std::vector<Bytes> samples_of(const std::filesystem::path& bag, const std::string& type) {
  sqlite3* database = nullptr;
  const std::string address = "file:" + bag.string() + "?immutable=1";
  EXPECT_EQ(
      sqlite3_open_v2(address.c_str(), &database, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr),
      SQLITE_OK);
  sqlite3_stmt* query = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(database,
                               "select data from messages join topics on topic_id = topics.id "
                               "where type = ? order by messages.id",
                               -1, &query, nullptr),
            SQLITE_OK);
  sqlite3_bind_text(query, 1, type.c_str(), -1, SQLITE_TRANSIENT);
  std::vector<Bytes> samples;
  while (sqlite3_step(query) == SQLITE_ROW) {
    const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(query, 0));
    samples.emplace_back(data, data + sqlite3_column_bytes(query, 0));
  }
  sqlite3_finalize(query);
  sqlite3_close(database);
  return samples;
}

class RecordedBag : public testing::Test {
 protected:
  void SetUp() override {
    const auto file = shared_data("ros2/bags/macfirst_floor_take_2/macfirst_floor_take_2_0.db3");
    if (!file) GTEST_SKIP() << "not run: the recorded bag is not at hand";
    bag_ = *file;
  }

  /// Padding bytes of the recording may hold anything, so the objects are compared too when bytes
  /// differ.
  void expect_same_after_round_trip(TopicDataType& type, const std::string& name,
                                    std::size_t count) {
    const auto samples = samples_of(bag_, name);
    EXPECT_EQ(samples.size(), count);
    for (const Bytes& bytes : samples) {
      const auto sample = decode(type, bytes);
      ASSERT_TRUE(sample);
      ASSERT_EQ(encode(type, sample), bytes);
    }
  }

  std::filesystem::path bag_;
};

TEST_F(RecordedBag, laser_scans_are_read_and_written_to_the_byte) {
  sensor_msgs::msg::LaserScanPubSubType type;
  expect_same_after_round_trip(type, "sensor_msgs/msg/LaserScan", 357);
}

TEST_F(RecordedBag, odometry_is_read_and_written_to_the_byte) {
  nav_msgs::msg::OdometryPubSubType type;
  expect_same_after_round_trip(type, "nav_msgs/msg/Odometry", 920);
}

TEST_F(RecordedBag, transforms_are_read_and_written_to_the_byte) {
  tf2_msgs::msg::TFMessagePubSubType type;
  expect_same_after_round_trip(type, "tf2_msgs/msg/TFMessage", 953 + 2);
}

TEST_F(RecordedBag, the_robot_description_is_read_and_written_to_the_byte) {
  std_msgs::msg::StringPubSubType type;
  expect_same_after_round_trip(type, "std_msgs/msg/String", 1);
}

TEST_F(RecordedBag, decoded_values_are_those_of_a_robot_in_a_building) {
  sensor_msgs::msg::LaserScanPubSubType type;
  const auto samples = samples_of(bag_, "sensor_msgs/msg/LaserScan");
  ASSERT_FALSE(samples.empty());
  const auto sample = decode(type, samples.front());
  ASSERT_TRUE(sample);
  const auto& scan = *static_cast<const sensor_msgs::msg::LaserScan*>(sample.get());
  EXPECT_EQ(scan.ranges().size(), scan.intensities().size());
  EXPECT_NEAR(
      static_cast<double>(scan.angle_max() - scan.angle_min()),
      static_cast<double>(scan.angle_increment()) * static_cast<double>(scan.ranges().size() - 1),
      0.05);
  EXPECT_GT(scan.header().stamp().sec(), 1'600'000'000);
}

}  // namespace
}  // namespace coop::test
