#include "core/image/picture_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace coop {
namespace {

/// Three columns, two rows; every pixel differs.
cv::Mat small_picture() {
  cv::Mat picture(2, 3, CV_8UC3);
  for (int i = 0; i < 6; ++i) {
    picture.at<cv::Vec3b>(i / 3, i % 3) = {static_cast<std::uint8_t>(10 * i),
                                           static_cast<std::uint8_t>(100 + i),
                                           static_cast<std::uint8_t>(255 - i)};
  }
  return picture;
}

class PictureFile : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& bytes) const {
    const auto path = folder_.path() / "picture";
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  test::TemporaryFolder folder_;
};

TEST_F(PictureFile, WhatIsWrittenAsPngIsReadBackWithColoursInTheirOrder) {
  const cv::Mat drawn = small_picture();
  const auto read = read_picture(file(encode_png(drawn)));
  ASSERT_TRUE(read) << read.error();
  ASSERT_EQ(read->size(), drawn.size());
  for (int i = 0; i < 6; ++i) {
    const auto bgr = drawn.at<cv::Vec3b>(i / 3, i % 3);
    EXPECT_EQ(read->at<cv::Vec3b>(i / 3, i % 3), cv::Vec3b(bgr[2], bgr[1], bgr[0])) << i;
  }
}

TEST_F(PictureFile, APartOfALargerPictureIsWrittenWithoutItsNeighbours) {
  cv::Mat large(40, 50, CV_8UC3, cv::Scalar(1, 2, 3));
  small_picture().copyTo(large(cv::Rect(7, 5, 3, 2)));
  EXPECT_EQ(encode_png(large(cv::Rect(7, 5, 3, 2))), encode_png(small_picture()));
}

TEST_F(PictureFile, AJpegIsReadByWhatItHoldsNotByItsName) {
  cv::Mat grey(16, 24, CV_8UC3, cv::Scalar(60, 120, 200));  // red, green, blue
  unsigned char* data = nullptr;
  unsigned long size = 0;
  const tjhandle codec = tjInitCompress();
  ASSERT_EQ(tjCompress2(codec, grey.data, 24, 0, 16, TJPF_RGB, &data, &size, TJSAMP_444, 95, 0), 0);
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  tjFree(data);
  tjDestroy(codec);
  const auto read = read_picture(file(bytes));
  ASSERT_TRUE(read) << read.error();
  ASSERT_EQ(read->size(), cv::Size(24, 16));
  const auto pixel = read->at<cv::Vec3b>(8, 12);
  // Quality 95 keeps an even colour to a few steps of 255.
  EXPECT_NEAR(pixel[0], 60, 3);
  EXPECT_NEAR(pixel[1], 120, 3);
  EXPECT_NEAR(pixel[2], 200, 3);
  EXPECT_FALSE(read_picture(file(bytes.substr(0, bytes.size() / 2)))) << "cut in the middle";
}

TEST_F(PictureFile, WhatIsNoPictureIsAnErrorInOneLine) {
  EXPECT_FALSE(read_picture(folder_.path() / "nothing"));
  EXPECT_FALSE(read_picture(file("")));
  EXPECT_EQ(read_picture(file("no picture")).error(), "neither PNG nor JPEG");
  const std::string png = encode_png(small_picture());
  for (std::size_t length = 4; length < png.size() - 12; ++length) {
    EXPECT_FALSE(read_picture(file(png.substr(0, length)))) << length;
  }
}

TEST_F(PictureFile, APictureOfAbsurdSizeIsRefusedBeforeMemoryIsTaken) {
  std::string png = encode_png(small_picture());
  // Width and height are the first eight bytes of the first chunk; libpng checks the sum first.
  png.replace(16, 8, std::string("\x7F\xFF\xFF\xFF\x7F\xFF\xFF\xFF", 8));
  EXPECT_FALSE(read_picture(file(png)));
}

TEST_F(PictureFile, OnlyPicturesOfThreeColoursAreWritten) {
  EXPECT_THROW((void)encode_png(cv::Mat()), std::invalid_argument);
  EXPECT_THROW((void)encode_png(cv::Mat(2, 2, CV_8UC1)), std::invalid_argument);
}

}  // namespace
}  // namespace coop
