#include "conversions/detections.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace coop::conversions {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Stamped<std::vector<Detection>> one_egg() {
  Detection egg{"egg", 0.75, {1, 2, 3}, Eigen::Matrix3d::Identity() * 0.01, {0.06, 0.04, 0.04},
                "7"};
  return {Time(std::chrono::seconds(3)), "camera_optical_frame", {egg}};
}

TEST(DetectionConversion, an_egg_survives_the_round_trip) {
  const auto message = to_msg(one_egg());
  ASSERT_EQ(message.detections().size(), 1U);
  const auto& item = message.detections()[0];
  EXPECT_EQ(item.bbox().center().position().z(), 3.0);
  EXPECT_EQ(item.bbox().size().x(), 0.06);
  EXPECT_EQ(item.results()[0].pose().covariance()[14], 0.01);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->frame_id, "camera_optical_frame");
  EXPECT_EQ(back->stamp, Time(std::chrono::seconds(3)));
  const Detection& egg = back->value.at(0);
  EXPECT_EQ(egg.class_id, "egg");
  EXPECT_EQ(egg.score, 0.75);
  EXPECT_EQ(egg.position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(egg.covariance, one_egg().value[0].covariance);
  EXPECT_EQ(egg.size, Eigen::Vector3d(0.06, 0.04, 0.04));
  EXPECT_EQ(egg.id, "7");
}

TEST(DetectionConversion, an_empty_list_says_that_nothing_was_seen) {
  auto none = one_egg();
  none.value.clear();
  const auto back = from_msg(to_msg(none));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->value.empty());
}

TEST(DetectionConversion, the_hypothesis_with_the_highest_score_counts) {
  auto message = to_msg(one_egg());
  auto& results = message.detections()[0].results();
  results.push_back(results[0]);
  results[1].hypothesis().class_id("stone");
  results[1].hypothesis().score(0.9);
  EXPECT_EQ(from_msg(message)->value[0].class_id, "stone");
  results[1].hypothesis().score(0.75);
  EXPECT_EQ(from_msg(message)->value[0].class_id, "egg");
}

TEST(DetectionConversion, what_makes_no_sense_is_refused) {
  const auto refused = [](const auto& damage) {
    auto message = to_msg(one_egg());
    damage(message.detections()[0]);
    return !from_msg(message).has_value();
  };
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_TRUE(refused([](auto& d) { d.results().clear(); }));
  EXPECT_TRUE(refused([](auto& d) { d.results()[0].hypothesis().score(1.01); }));
  EXPECT_TRUE(refused([](auto& d) { d.results()[0].hypothesis().score(kNan); }));
  EXPECT_TRUE(refused([](auto& d) { d.results()[0].pose().pose().position().x(kNan); }));
  EXPECT_TRUE(refused([](auto& d) { d.results()[0].pose().covariance()[0] = -1.0; }));
  EXPECT_TRUE(refused([](auto& d) { d.bbox().size().y(-0.1); }));
  EXPECT_TRUE(refused([](auto& d) { d.bbox().size().y(kNan); }));
  EXPECT_TRUE(refused([](auto& d) { d.header().frame_id("map"); }));
}

TEST(DetectionConversion, absurdly_many_detections_are_refused) {
  auto many = one_egg();
  many.value.assign(kMaxDetections + 1, many.value[0]);
  EXPECT_FALSE(from_msg(to_msg(many)));
}

}  // namespace
}  // namespace coop::conversions
