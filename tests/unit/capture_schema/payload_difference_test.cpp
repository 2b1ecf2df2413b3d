#include "capture/schema/payload_difference.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "unit/capture_schema/cdr_bytes.hpp"

namespace coop::capture {
namespace {

using test::CdrBytes;

const MessageLayout& layout() {
  static const MessageLayout kLayout("p/M",
                                     "string name\nInner[] list\nE empty\nuint8 last\n"
                                     "===\nMSG: p/Inner\nfloat64 x\nfloat32[] data\n"
                                     "===\nMSG: p/E\n");
  return kLayout;
}

struct Values {
  const char* name = "a";
  double x = 1.0;
  float data = 2.0F;
  std::uint32_t count = 2;
  std::uint8_t last = 3;
  bool little_endian = true;
};

CdrBytes message(const Values& values) {
  CdrBytes bytes(values.little_endian);
  bytes.text(values.name).length(2);
  bytes.put(1.0).length(1).put(0.5F);
  bytes.put(values.x).length(values.count);
  for (std::uint32_t i = 0; i < values.count; ++i) bytes.put(values.data);
  return bytes.put(std::uint8_t{0}).put(values.last);
}

std::string difference(const Values& a, const Values& b) {
  const auto found = first_difference(layout(), message(a), message(b));
  if (!found) return found.error().text();
  if (!*found) return "same";
  return (*found)->path + ": " + (*found)->first + " / " + (*found)->second;
}

TEST(PayloadDifference, the_first_field_that_differs_is_named) {
  EXPECT_EQ(difference({}, {}), "same");
  EXPECT_EQ(difference({}, {.name = "b", .last = 4}), "name: \"a\" / \"b\"");
  EXPECT_EQ(difference({}, {.x = 1.5, .data = 7.0F}), "list[1].x: 1 / 1.5");
  EXPECT_EQ(difference({}, {.data = 7.0F}), "list[1].data[0]: 2 / 7");
  EXPECT_EQ(difference({}, {.count = 3}), "list[1].data: 2 elements / 3 elements");
  EXPECT_EQ(difference({}, {.last = 4}), "last: 3 / 4");
}

TEST(PayloadDifference, byte_order_and_ways_to_write_the_same_value_do_not_count) {
  EXPECT_EQ(difference({}, {.little_endian = false}), "same");
  EXPECT_EQ(difference({.x = 0.0}, {.x = -0.0}), "same");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(difference({.data = nan}, {.data = -nan}), "same");
  EXPECT_EQ(difference({.data = nan}, {.data = 1.0F}), "list[1].data[0]: nan / 1");
}

TEST(PayloadDifference, a_malformed_message_is_said_to_be_so) {
  const auto whole = message({});
  auto cut = message({});
  cut.bytes().resize(cut.bytes().size() - 1);
  const auto second = first_difference(layout(), whole, cut);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().reason, "in the second: the payload ends");
  const auto first = first_difference(layout(), cut, whole);
  ASSERT_FALSE(first);
  EXPECT_EQ(first.error().text().substr(0, 4), "last");
}

}  // namespace
}  // namespace coop::capture
