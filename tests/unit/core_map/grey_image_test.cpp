#include "core/map/grey_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.hpp"

namespace coop::map {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Pgm, ReadsTextWithCommentsAnywhereInTheHeader) {
  const auto image =
      parse_pgm("P2 # text\n# made by hand\n3 # wide\n2\n9\n0 1 2\n3 4 9\n", "t.pgm");
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.max_value, 9);
  EXPECT_THAT(image.pixels, ElementsAre(0, 1, 2, 3, 4, 9));
}

TEST(Pgm, ReadsBinary) {
  const auto image = parse_pgm(std::string("P5\n2 2\n255\n\x00\x7f\xfe\xff", 15), "t.pgm");
  EXPECT_THAT(image.pixels, ElementsAre(0, 127, 254, 255));
}

TEST(Pgm, BinaryPixelsMayLookLikeBlanksAndComments) {
  const auto image = parse_pgm("P5 2 2 255\n# \n\t", "t.pgm");
  EXPECT_THAT(image.pixels, ElementsAre('#', ' ', '\n', '\t'));
}

TEST(Pgm, ReadsSixteenBitMostSignificantByteFirst) {
  const auto image = parse_pgm(std::string("P5 1 2 1000\n\x01\x02\x03\xe8", 16), "t.pgm");
  EXPECT_THAT(image.pixels, ElementsAre(0x0102, 1000));
}

TEST(Pgm, WhatIsWrittenIsReadBack) {
  const GreyImage image{3, 2, 255, {0, 205, 254, 255, 1, 35}};
  const auto again = parse_pgm(to_pgm(image, "a comment"), "t.pgm");
  EXPECT_EQ(again.width, 3);
  EXPECT_EQ(again.pixels, image.pixels);
}

struct BadImage {
  const char* name;
  std::string content;
  const char* message;
};

class BadPgm : public testing::TestWithParam<BadImage> {};

TEST_P(BadPgm, IsRefusedWithTheFileAndTheReason) {
  EXPECT_THAT(
      [] { (void)parse_pgm(GetParam().content, "bad.pgm"); },
      ThrowsMessage<MapError>(testing::AllOf(HasSubstr("bad.pgm"), HasSubstr(GetParam().message))));
}

INSTANTIATE_TEST_SUITE_P(
    Pgm, BadPgm,
    testing::Values(BadImage{"empty", "", "P2 or P5"},
                    BadImage{"another_format", "\x89PNG\r\n", "P2 or P5"},
                    BadImage{"colour", "P6 1 1 255\nabc", "P2 or P5"},
                    BadImage{"no_width", "P5\n", "the width"},
                    BadImage{"negative_height", "P5 4 -3 255\n", "the height"},
                    BadImage{"maximum_too_large", "P5 1 1 65536\nab", "the maximum"},
                    BadImage{"no_pixels", "P5 0 5 255\n", "empty image"},
                    BadImage{"too_few_bytes", "P5 10 1 255\nabc", "pixels"},
                    BadImage{"half_of_wide_pixels", "P5 8 1 1000\nabcdefgh", "expected 16 bytes"},
                    BadImage{"huge_for_its_file", "P5 30000 30000 255\nabc", "fewer pixels"},
                    BadImage{"larger_than_memory", "P5 2000000000 2000000000 255\nabc", "2^30"},
                    BadImage{"text_pixel_above_maximum", "P2 2 1 9\n3 10\n", "a pixel"},
                    BadImage{"binary_pixel_above_maximum", "P5 2 1 9\n\x01\x0a",
                             "above the maximum"},
                    BadImage{"text_too_short", "P2 2 2 9\n1 2 3     \n", "a pixel"}),
    [](const auto& bad) { return std::string(bad.param.name); });

TEST(Pgm, DamagedFilesEitherReadOrAreRefusedNeverMore) {
  RandomStream random(1, "damaged images");
  for (int trial = 0; trial < 5000; ++trial) {
    std::string content =
        trial % 2 == 0 ? "P2 4 3 9\n0 1 2 3 4 5 6 7 8 9 0 1\n" : "P5 4 3 255\nabcdefghijkl";
    for (int i = 0; i < 3; ++i)
      content[random.below(content.size())] = static_cast<char>(random.below(256));
    content.resize(content.size() - random.below(3));
    try {
      const auto image = parse_pgm(content, "damaged.pgm");
      ASSERT_EQ(image.pixels.size(),
                static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    } catch (const MapError&) {
      // refused: fine
    }
  }
}

}  // namespace
}  // namespace coop::map
