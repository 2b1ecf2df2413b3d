// The bytes on the wire: two messages written by hand, and every type against an encoder of our own
// that knows only the IDL text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "idl_headers.hpp"
#include "idl_lists.hpp"
#include "unit/idl/cdr_sample.hpp"
#include "unit/idl/fast_cdr.hpp"
#include "unit/idl/topic_type.hpp"

namespace coop::test {
namespace {

struct NamedTopicType {
  std::string name;
  std::unique_ptr<TopicDataType> type;
};

std::vector<NamedTopicType> topic_types() {
  std::vector<NamedTopicType> types;
#define COOP_ADD(package, type) \
  types.push_back({#package "/" #type, std::make_unique<package::msg::type##PubSubType>()});
  COOP_IDL_MESSAGES(COOP_ADD)
#undef COOP_ADD
  return types;
}

const Schema& schema() {
  static const Schema kSchema = load_idl(std::filesystem::path(COOP_SOURCE_DIR) / "idl");
  return kSchema;
}

// clang-format off
const Bytes kLaserScanBytes = {
    0x00, 0x01, 0x00, 0x00,                          // plain CDR, little endian
    0x01, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00,  // stamp 1 s 2 ns
    0x06, 0x00, 0x00, 0x00, 'l', 'a', 's', 'e', 'r', 0x00, 0x00, 0x00,  // frame_id, then 2 bytes to the next multiple of 4
    0x00, 0x00, 0x80, 0xbf,                          // angle_min -1
    0x00, 0x00, 0x80, 0x3f,                          // angle_max 1
    0x00, 0x00, 0x00, 0x3f,                          // angle_increment 0.5
    0x00, 0x00, 0x00, 0x00,                          // time_increment 0
    0x00, 0x00, 0x80, 0x3e,                          // scan_time 0.25
    0x00, 0x00, 0x00, 0x3e,                          // range_min 0.125
    0x00, 0x00, 0x00, 0x41,                          // range_max 8
    0x02, 0x00, 0x00, 0x00, 0x00, 0x00, 0xc0, 0x3f, 0x00, 0x00, 0x80, 0x7f,  // ranges 1.5, infinity
    0x00, 0x00, 0x00, 0x00};                         // no intensities

// The doubles begin 32 bytes behind the encapsulation, where a count from the start of the buffer would pad by 4 more.
const Bytes kTfMessageBytes = {
    0x00, 0x01, 0x00, 0x00,
    0x01, 0x00, 0x00, 0x00,                          // one transform
    0x03, 0x00, 0x00, 0x00, 0x04, 0x00, 0x00, 0x00,  // stamp 3 s 4 ns
    0x04, 0x00, 0x00, 0x00, 'm', 'a', 'p', 0x00,     // frame_id
    0x05, 0x00, 0x00, 0x00, 'o', 'd', 'o', 'm', 0x00, 0x00, 0x00, 0x00,  // child_frame_id, 3 bytes of padding
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xf0, 0x3f,  // translation 1
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xc0,  // -2
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,  // 0
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,  // rotation: none
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xf0, 0x3f};
// clang-format on

TEST(Cdr, a_laser_scan_has_the_bytes_written_by_hand) {
  auto type = std::make_unique<sensor_msgs::msg::LaserScanPubSubType>();
  auto sample = create_sample(*type);
  auto& scan = *static_cast<sensor_msgs::msg::LaserScan*>(sample.get());
  scan.header().stamp().sec(1);
  scan.header().stamp().nanosec(2);
  scan.header().frame_id("laser");
  scan.angle_min(-1.0F);
  scan.angle_max(1.0F);
  scan.angle_increment(0.5F);
  scan.scan_time(0.25F);
  scan.range_min(0.125F);
  scan.range_max(8.0F);
  scan.ranges({1.5F, std::numeric_limits<float>::infinity()});

  EXPECT_EQ(encode(*type, sample), kLaserScanBytes);
  const auto back = decode(*type, kLaserScanBytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(*static_cast<sensor_msgs::msg::LaserScan*>(back.get()), scan);
}

TEST(Cdr, a_transform_message_has_the_bytes_written_by_hand) {
  auto type = std::make_unique<tf2_msgs::msg::TFMessagePubSubType>();
  auto sample = create_sample(*type);
  auto& message = *static_cast<tf2_msgs::msg::TFMessage*>(sample.get());
  auto& transform = message.transforms().emplace_back();
  transform.header().stamp().sec(3);
  transform.header().stamp().nanosec(4);
  transform.header().frame_id("map");
  transform.child_frame_id("odom");
  transform.transform().translation().x(1.0);
  transform.transform().translation().y(-2.0);

  EXPECT_EQ(encode(*type, sample), kTfMessageBytes);
  const auto back = decode(*type, kTfMessageBytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(*static_cast<tf2_msgs::msg::TFMessage*>(back.get()), message);
}

TEST(Cdr, big_endian_samples_are_read) {
  sensor_msgs::msg::LaserScanPubSubType type;
  Bytes bytes = kLaserScanBytes;
  bytes[1] = 0x00;
  const auto reverse = [&bytes](std::size_t at) {
    std::reverse(bytes.begin() + static_cast<long>(at), bytes.begin() + static_cast<long>(at) + 4);
  };
  for (const std::size_t at : {4u, 8u, 12u}) reverse(at);
  for (std::size_t at = 24; at < bytes.size(); at += 4) reverse(at);
  const auto sample = decode(type, bytes);
  ASSERT_TRUE(sample);
  EXPECT_EQ(encode(type, sample), kLaserScanBytes);
}

TEST(Cdr, every_type_is_read_and_written_as_its_idl_says) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
#define COOP_CHECK(package, type)                                           \
  {                                                                         \
    const Bytes bytes = CdrSample(schema(), seed)(#package "/" #type);      \
    EXPECT_EQ(reencode<package::msg::type>(bytes), bytes) << #type << seed; \
  }
    COOP_IDL_TYPES(COOP_CHECK)
#undef COOP_CHECK
  }
}

TEST(Cdr, every_topic_type_announces_at_least_the_size_it_needs) {
  for (const auto& [name, type] : topic_types()) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
      const Bytes bytes = CdrSample(schema(), seed)(name);
      const auto sample = decode(*type, bytes);
      ASSERT_TRUE(sample) << name;
      EXPECT_EQ(encode(*type, sample), bytes) << name;
    }
  }
}

TEST(Cdr, type_names_follow_the_rule_of_ros2) {
  for (const auto& [name, type] : topic_types()) {
    const auto slash = name.find('/');
    EXPECT_EQ(std::string(type->getName()),
              name.substr(0, slash) + "::msg::dds_::" + name.substr(slash + 1) + "_");
  }
}

TEST(Cdr, samples_cut_short_anywhere_are_refused) {
  for (const auto& [name, type] : topic_types()) {
    const Bytes bytes = CdrSample(schema(), 7)(name);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const Bytes part(bytes.begin(), bytes.begin() + static_cast<long>(length));
      EXPECT_FALSE(decode(*type, part)) << name << " cut to " << length;
    }
  }
}

TEST(Cdr, a_boolean_that_is_neither_0_nor_1_is_refused) {
  coop_msgs::msg::EmergencyStopPubSubType type;
  const auto sample = create_sample(type);
  Bytes bytes = encode(type, sample);
  ASSERT_TRUE(decode(type, bytes));
  const std::size_t engaged = 4 + 8 + 5;  // encapsulation, stamp, empty frame_id
  ASSERT_EQ(bytes.at(engaged), 0);
  bytes[engaged] = 2;
  EXPECT_FALSE(decode(type, bytes));
}

// The parameter lists of version 1 (0x02, 0x03) are read like plain CDR by Fast CDR; no writer of a
// final type sends them.
TEST(Cdr, the_encapsulations_of_version_2_are_refused) {
  std_msgs::msg::StringPubSubType type;
  Bytes bytes = encode(type, create_sample(type));
  for (const std::uint8_t kind : Bytes{0x06, 0x07, 0x0a, 0x0b, 0xff}) {
    bytes[1] = kind;
    EXPECT_FALSE(decode(type, bytes)) << int{kind};
  }
}

TEST(Cdr, a_length_beyond_the_end_is_refused_without_allocating_it) {
  nav_msgs::msg::PathPubSubType type;
  Bytes bytes = encode(type, create_sample(type));
  for (std::size_t i = bytes.size() - 4; i < bytes.size(); ++i) bytes[i] = 0xff;
  EXPECT_FALSE(decode(type, bytes));
}

TEST(Cdr, damaged_bytes_never_do_more_than_change_the_content) {
  std::mt19937_64 random(11);
  for (const auto& [name, type] : topic_types()) {
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
      Bytes bytes = CdrSample(schema(), seed)(name);
      for (int i = 0; i < 3; ++i) {
        bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
      }
      const auto sample = decode(*type, bytes);
      if (!sample) continue;
      const Bytes again = encode(*type, sample);
      ASSERT_FALSE(again.empty()) << name;
      const auto copy = decode(*type, again);
      ASSERT_TRUE(copy) << name;
      EXPECT_EQ(encode(*type, copy), again) << name;
    }
  }
}

TEST(Cdr, the_key_of_a_status_is_its_source_alone) {
  coop_msgs::msg::NavigationStatusPubSubType type;
  const auto key_of = [&type](const std::string& source, const std::string& detail) {
    coop_msgs::msg::NavigationStatus status;
    status.source(source);
    status.detail(detail);
    eprosima::fastrtps::rtps::InstanceHandle_t handle;
    EXPECT_TRUE(type.getKey(&status, &handle, false));
    return handle;
  };
  EXPECT_TRUE(type.m_isGetKeyDefined);
  EXPECT_EQ(key_of("dwa", "driving"), key_of("dwa", "stuck"));
  EXPECT_NE(key_of("dwa", ""), key_of("global_planner", ""));
}

TEST(Cdr, a_new_pose_has_a_valid_rotation) {
  EXPECT_EQ(geometry_msgs::msg::Pose().orientation().w(), 1.0);
}

}  // namespace
}  // namespace coop::test
