#include "capture/schema/message_text.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "capture/schema/definitions.hpp"
#include "capture/schema/number_text.hpp"
#include "unit/capture_schema/cdr_bytes.hpp"

namespace coop::capture {
namespace {

using test::CdrBytes;

std::string yaml(const MessageLayout& layout, const CdrBytes& bytes, std::size_t most = SIZE_MAX) {
  std::string out;
  EXPECT_TRUE(append_yaml(layout, bytes, {.max_elements = most}, out));
  return out;
}

std::string json(const MessageLayout& layout, const CdrBytes& bytes, std::size_t most = SIZE_MAX) {
  std::string out;
  EXPECT_TRUE(append_json(layout, bytes, {.max_elements = most}, out));
  return out;
}

CdrBytes scan() {
  CdrBytes bytes;
  bytes.put(std::int32_t{1}).put(std::uint32_t{2}).text("laser_link");
  for (const float value : {-1.5F, 1.0F, 0.1F, 0.0F, 0.1F, 0.05F, 8.0F}) bytes.put(value);
  bytes.length(3).put(1.25F).put(std::numeric_limits<float>::infinity());
  bytes.put(std::numeric_limits<float>::quiet_NaN());
  return bytes.length(0);
}

MessageLayout scan_layout() {
  return {"sensor_msgs/LaserScan", *ros2msg_definition("sensor_msgs/LaserScan")};
}

TEST(MessageText, a_scan_is_shown_as_yaml) {
  EXPECT_EQ(yaml(scan_layout(), scan()),
            "header:\n  stamp:\n    sec: 1\n    nanosec: 2\n  frame_id: laser_link\n"
            "angle_min: -1.5\nangle_max: 1.0\nangle_increment: 0.1\ntime_increment: 0.0\n"
            "scan_time: 0.1\nrange_min: 0.05\nrange_max: 8.0\n"
            "ranges:\n- 1.25\n- .inf\n- .nan\nintensities: []\n");
}

TEST(MessageText, a_scan_is_shown_as_json) {
  EXPECT_EQ(json(scan_layout(), scan()),
            R"({"header":{"stamp":{"sec":1,"nanosec":2},"frame_id":"laser_link"},)"
            R"("angle_min":-1.5,"angle_max":1.0,"angle_increment":0.1,"time_increment":0.0,)"
            R"("scan_time":0.1,"range_min":0.05,"range_max":8.0,)"
            R"("ranges":[1.25,"Infinity","NaN"],"intensities":[]})");
}

const MessageLayout& nested_layout() {
  static const MessageLayout kLayout("p/M",
                                     "Inner[] list\nstring[] words\n===\nMSG: p/Inner\n"
                                     "Leaf leaf\nuint8[] data\n===\nMSG: p/Leaf\nint8 x\n");
  return kLayout;
}

CdrBytes nested() {
  CdrBytes bytes;
  bytes.length(3);
  for (int i = 0; i < 3; ++i) {
    bytes.put(static_cast<std::int8_t>(-i)).length(2);
    bytes.put(std::uint8_t{200}).put(std::uint8_t{100});
  }
  return bytes.length(2).text("a b").text("");
}

TEST(MessageText, elements_stand_behind_dashes) {
  EXPECT_EQ(yaml(nested_layout(), nested()),
            "list:\n- leaf:\n    x: 0\n  data:\n  - 200\n  - 100\n"
            "- leaf:\n    x: -1\n  data:\n  - 200\n  - 100\n"
            "- leaf:\n    x: -2\n  data:\n  - 200\n  - 100\nwords:\n- a b\n- ''\n");
}

TEST(MessageText, long_arrays_are_cut_where_wished) {
  EXPECT_EQ(yaml(nested_layout(), nested(), 1),
            "list:\n- leaf:\n    x: 0\n  data:\n  - 200\n  - '...'\n- '...'\n"
            "words:\n- a b\n- '...'\n");
  EXPECT_EQ(json(nested_layout(), nested(), 1),
            R"({"list":[{"leaf":{"x":0},"data":[200,"..."]},"..."],"words":["a b","..."]})");
  EXPECT_EQ(json(nested_layout(), nested(), 0), R"({"list":["..."],"words":["..."]})");
}

TEST(MessageText, text_of_any_bytes_gives_valid_json) {
  std::string out;
  append_json_string(out, "a\"\\\n\t\x01\x7f \xC3\xA4 \xFF \xE2\x82 \xED\xA0\x80");
  EXPECT_EQ(out,
            "\"a\\\"\\\\\\n\\t\\u0001\\u007f \xC3\xA4 \xEF\xBF\xBD \xEF\xBF\xBD\xEF\xBF\xBD "
            "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\"");
}

TEST(MessageText, strings_that_yaml_would_take_for_something_else_are_quoted) {
  const auto shown = [](std::string_view text) {
    std::string out;
    append_yaml_string(out, text);
    return out;
  };
  EXPECT_EQ(shown("base_link"), "base_link");
  EXPECT_EQ(shown("True"), "'True'");
  EXPECT_EQ(shown("1.0"), "'1.0'");
  EXPECT_EQ(shown("it's: so"), "'it''s: so'");
  EXPECT_EQ(shown("two\nlines"), "\"two\\nlines\"");
  EXPECT_EQ(shown(""), "''");
}

TEST(MessageText, numbers_read_back_as_the_same) {
  const auto shown = [](Primitive type, std::uint64_t bits, TextStyle style) {
    std::string out;
    append_number(out, {type, bits}, style);
    return out;
  };
  EXPECT_EQ(shown(Primitive::kInt64, std::uint64_t{1} << 63, TextStyle::kJson),
            "-9223372036854775808");
  EXPECT_EQ(shown(Primitive::kUint64, UINT64_MAX, TextStyle::kJson), "18446744073709551615");
  EXPECT_EQ(shown(Primitive::kInt8, 0xFF, TextStyle::kPlain), "-1");
  EXPECT_EQ(shown(Primitive::kBool, 1, TextStyle::kPlain), "true");
  EXPECT_EQ(shown(Primitive::kFloat64, std::bit_cast<std::uint64_t>(1e300), TextStyle::kYaml),
            "1.0e+300");
  EXPECT_EQ(shown(Primitive::kFloat64, std::bit_cast<std::uint64_t>(1e300), TextStyle::kPlain),
            "1e+300");
  EXPECT_EQ(shown(Primitive::kFloat32, std::bit_cast<std::uint32_t>(0.1F), TextStyle::kPlain),
            "0.1");
}

TEST(MessageText, a_malformed_message_leaves_no_half_of_json) {
  auto bytes = scan();
  bytes.bytes().resize(40);
  std::string out = "before";
  const auto written = append_json(scan_layout(), bytes, {}, out);
  ASSERT_FALSE(written);
  EXPECT_EQ(out, "before");
  EXPECT_EQ(written.error().path, "time_increment");
}

}  // namespace
}  // namespace coop::capture
