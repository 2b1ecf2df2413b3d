#include "referee/judgement.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace coop::referee {
namespace {

const Eigen::Vector2d kWorkingPoint(0.92, 0.0);
const robot::WorkingRange kRange{.along = 0.10, .across = 0.12};

/// The robot at the origin looking along x, everything right: the egg in the working point.
Standing perfect() {
  Standing standing;
  standing.egg_in_map = kWorkingPoint;
  standing.believed_egg_in_map = kWorkingPoint;
  return standing;
}

void expect_parts_add_up(const Arrival& arrival) {
  EXPECT_LT(
      (arrival.by_control + arrival.by_egg + arrival.by_localisation - arrival.deviation).norm(),
      1e-12);
}

TEST(Judgement, without_errors_the_egg_lies_in_the_working_point) {
  const Arrival arrival = analyse(perfect(), kWorkingPoint);
  EXPECT_LT(arrival.deviation.norm(), 1e-12);
  EXPECT_NEAR(arrival.heading_error, 0.0, 1e-12);
  EXPECT_EQ(cause_of_miss(arrival, kRange), Cause::kNone);
}

TEST(Judgement, a_robot_that_stops_too_early_has_an_error_of_control) {
  Standing standing = perfect();
  standing.robot_in_map.x = -0.2;
  standing.believed_robot_in_map.x = -0.2;
  const Arrival arrival = analyse(standing, kWorkingPoint);
  EXPECT_NEAR(arrival.deviation.x(), 0.2, 1e-12);
  EXPECT_NEAR(arrival.by_control.x(), 0.2, 1e-12);
  EXPECT_EQ(cause_of_miss(arrival, kRange), Cause::kControlError);
  expect_parts_add_up(arrival);
}

TEST(Judgement, an_egg_believed_elsewhere_has_an_error_of_position) {
  Standing standing = perfect();
  standing.egg_in_map.y() = 0.15;
  const Arrival arrival = analyse(standing, kWorkingPoint);
  EXPECT_NEAR(arrival.by_egg.y(), 0.15, 1e-12);
  EXPECT_EQ(cause_of_miss(arrival, kRange), Cause::kEggPositionError);
  EXPECT_NEAR(arrival.heading_error, std::atan2(0.15, 0.92), 1e-12);
}

TEST(Judgement, a_robot_that_is_not_where_it_thinks_has_an_error_of_localisation) {
  Standing standing = perfect();
  standing.robot_in_map = {0.0, 0.0, 0.2};
  const Arrival arrival = analyse(standing, kWorkingPoint);
  EXPECT_NEAR(arrival.egg_in_base.x(), 0.92 * std::cos(0.2), 1e-12);
  EXPECT_NEAR(arrival.egg_in_base.y(), -0.92 * std::sin(0.2), 1e-12);
  EXPECT_NEAR(arrival.yaw_error, -0.2, 1e-12);
  EXPECT_EQ(cause_of_miss(arrival, kRange), Cause::kLocalisationError);
  expect_parts_add_up(arrival);
}

TEST(Judgement, of_two_errors_the_one_that_makes_the_miss_is_named) {
  Arrival arrival;
  arrival.by_control = {0.03, 0.0};
  arrival.by_egg = {0.09, 0.0};
  arrival.deviation = {0.12, 0.0};
  EXPECT_EQ(cause_of_miss(arrival, kRange), Cause::kEggPositionError);
}

TEST(Judgement, errors_that_cancel_are_no_miss) {
  Standing standing = perfect();
  standing.robot_in_map.x = 0.5;
  standing.egg_in_map.x() += 0.5;
  const Arrival arrival = analyse(standing, kWorkingPoint);
  EXPECT_NEAR(arrival.by_egg.x(), 0.5, 1e-12);
  EXPECT_NEAR(arrival.by_localisation.x(), -0.5, 1e-12);
  EXPECT_EQ(cause_of_miss(arrival, kRange), Cause::kNone);
}

TEST(Judgement, where_no_error_suffices_alone_they_are_named_together) {
  Arrival arrival;
  arrival.by_control = {0.15, 0.0};
  arrival.by_egg = {0.15, 0.0};
  arrival.by_localisation = {0.15, 0.0};
  arrival.deviation = {0.45, 0.0};
  EXPECT_EQ(cause_of_miss(arrival, kRange), Cause::kErrorsTogether);
}

TEST(Judgement, the_border_belongs_to_the_range) {
  Arrival arrival;
  arrival.deviation = {0.10, -0.12};
  EXPECT_EQ(cause_of_miss(arrival, kRange), Cause::kNone);
}

}  // namespace
}  // namespace coop::referee
