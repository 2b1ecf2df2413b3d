#include "conversions/image.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace coop::conversions {
namespace {

/// Two rows of three: (row, column) -> bytes 10 * row + column, and so on through the channels.
Picture small_picture() {
  Picture picture{Time(std::chrono::seconds(4)), "camera_optical_frame", "rgb8", {}};
  picture.pixels.create(2, 3, CV_8UC3);
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      const auto value = static_cast<std::uint8_t>(10 * row + column);
      picture.pixels.at<cv::Vec3b>(row, column) = cv::Vec3b(value, 100, 200);
    }
  }
  return picture;
}

sensor_msgs::msg::Image message() {
  return *to_msg(small_picture());
}

TEST(ImageConversion, rows_are_written_without_gaps) {
  const auto image = message();
  EXPECT_EQ(image.width(), 3U);
  EXPECT_EQ(image.height(), 2U);
  EXPECT_EQ(image.step(), 9U);
  EXPECT_EQ(image.data().size(), 18U);
  EXPECT_EQ(image.data()[0], 0);
  EXPECT_EQ(image.data()[2], 200);
  EXPECT_EQ(image.data()[9], 10);
}

TEST(ImageConversion, part_of_a_larger_picture_is_written_like_a_whole_one) {
  cv::Mat large(10, 10, CV_8UC3, cv::Scalar(1, 2, 3));
  Picture picture = small_picture();
  picture.pixels.copyTo(large(cv::Rect(4, 5, 3, 2)));
  picture.pixels = large(cv::Rect(4, 5, 3, 2));
  EXPECT_EQ(to_msg(picture)->data(), message().data());
}

TEST(ImageConversion, pictures_of_every_encoding_survive_the_round_trip) {
  for (const auto& [encoding, type] : {std::pair{"rgb8", CV_8UC3},
                                       {"bgr8", CV_8UC3},
                                       {"mono8", CV_8UC1},
                                       {"16UC1", CV_16UC1},
                                       {"32FC1", CV_32FC1}}) {
    Picture picture{Time(std::chrono::seconds(4)), "camera", encoding, {}};
    picture.pixels.create(4, 5, type);
    cv::randu(picture.pixels, 0, 200);
    const auto back = from_msg(*to_msg(picture));
    ASSERT_TRUE(back) << encoding;
    EXPECT_EQ(back->pixels.type(), type);
    EXPECT_EQ(cv::norm(back->pixels, picture.pixels, cv::NORM_INF), 0.0) << encoding;
    EXPECT_EQ(back->encoding, encoding);
    EXPECT_EQ(back->frame_id, "camera");
    EXPECT_EQ(back->stamp, picture.stamp);
  }
}

TEST(ImageConversion, rows_with_gaps_are_read) {
  auto image = message();
  image.step(10);
  auto& data = image.data();
  data.insert(data.begin() + 9, 77);
  data.push_back(77);
  const auto back = from_msg(image);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->pixels.at<cv::Vec3b>(1, 0), cv::Vec3b(10, 100, 200));
}

TEST(ImageConversion, sizes_that_do_not_fit_are_refused) {
  auto image = message();
  image.data().pop_back();
  EXPECT_FALSE(from_msg(image));
  image = message();
  image.step(8);
  EXPECT_FALSE(from_msg(image));
  image = message();
  image.height(0);
  EXPECT_FALSE(from_msg(image));
  image = message();
  image.width(0xffffffff);
  EXPECT_FALSE(from_msg(image));
  image = message();
  image.height(0xffffffff);
  image.step(0xffffffff);
  EXPECT_FALSE(from_msg(image));
}

TEST(ImageConversion, unknown_encodings_and_foreign_byte_orders_are_refused) {
  auto image = message();
  image.encoding("yuv422");
  EXPECT_FALSE(from_msg(image));
  image = message();
  image.is_bigendian(1);
  EXPECT_TRUE(from_msg(image)) << "single bytes have no order";
  image.encoding("16UC1");
  image.width(1);
  EXPECT_FALSE(from_msg(image));
  image.is_bigendian(0);
  EXPECT_TRUE(from_msg(image));
}

TEST(ImageConversion, pixels_that_are_not_what_the_encoding_says_are_not_sent) {
  auto picture = small_picture();
  picture.encoding = "mono8";
  EXPECT_FALSE(to_msg(picture));
  picture.pixels = cv::Mat();
  EXPECT_FALSE(to_msg(picture));
}

}  // namespace
}  // namespace coop::conversions
