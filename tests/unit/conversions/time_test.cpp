#include "conversions/time.hpp"

#include <gtest/gtest.h>

namespace coop::conversions {
namespace {

TEST(TimeConversion, whole_and_fractional_seconds_are_split) {
  const auto message = to_msg(Time(Duration(12'000'000'034)));
  EXPECT_EQ(message.sec(), 12);
  EXPECT_EQ(message.nanosec(), 34U);
}

TEST(TimeConversion, a_negative_duration_is_rounded_down_to_seconds_with_positive_nanoseconds) {
  const auto message = to_msg(Duration(-250'000'000));
  EXPECT_EQ(message.sec(), -1);
  EXPECT_EQ(message.nanosec(), 750'000'000U);
  EXPECT_EQ(from_msg(message), Duration(-250'000'000));
  EXPECT_EQ(to_msg(Duration(-2'000'000'000)).sec(), -2);
  EXPECT_EQ(to_msg(Duration(-2'000'000'000)).nanosec(), 0U);
}

TEST(TimeConversion, every_nanosecond_survives_the_round_trip) {
  for (const std::int64_t value : {0L, 1L, -1L, 999'999'999L, 1'000'000'000L, -1'000'000'000L,
                                   1'700'000'000'123'456'789L, -1'700'000'000'123'456'789L}) {
    EXPECT_EQ(from_msg(to_msg(Time(Duration(value)))), Time(Duration(value)));
    EXPECT_EQ(from_msg(to_msg(Duration(value))), Duration(value));
    EXPECT_EQ(from_msg(to_clock_msg(Time(Duration(value)))), Time(Duration(value)));
  }
}

TEST(TimeConversion, times_beyond_the_message_become_the_nearest_it_can_hold) {
  EXPECT_EQ(to_msg(Time::max()).sec(), 2147483647);
  EXPECT_EQ(to_msg(Time::max()).nanosec(), 999'999'999U);
  EXPECT_EQ(to_msg(Time::min()).sec(), -2147483647 - 1);
  EXPECT_EQ(to_msg(Time::min()).nanosec(), 0U);
}

TEST(TimeConversion, a_nanosecond_field_of_a_second_is_refused) {
  builtin_interfaces::msg::Time message;
  message.nanosec(999'999'999);
  EXPECT_TRUE(from_msg(message));
  message.nanosec(1'000'000'000);
  EXPECT_FALSE(from_msg(message));
  message.nanosec(0xffffffff);
  EXPECT_FALSE(from_msg(message));
}

TEST(TimeConversion, a_header_holds_stamp_and_frame) {
  const auto header = to_header(Time(Duration(5'000'000'001)), "map");
  EXPECT_EQ(header.stamp().sec(), 5);
  EXPECT_EQ(header.stamp().nanosec(), 1U);
  EXPECT_EQ(header.frame_id(), "map");
}

}  // namespace
}  // namespace coop::conversions
