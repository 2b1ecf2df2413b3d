#include "core/carmen/playback_position.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace coop::carmen {
namespace {

const PlaybackPosition::Log kLog{100, time_from_seconds(5000.0), time_from_seconds(5010.0)};
const PlaybackPosition::Mark kMark{42, time_from_seconds(5004.2), 2};

class PlaybackPositionTest : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "run" / "chassis_driver.position";
};

TEST_F(PlaybackPositionTest, AFirstLifeFindsNothing) {
  EXPECT_FALSE(PlaybackPosition(path_, kLog).found());
  EXPECT_FALSE(PlaybackPosition(path_, kLog).found()) << "nothing was written";
}

TEST_F(PlaybackPositionTest, ALaterLifeFindsTheNewestMarkAndGoesOnWriting) {
  {
    PlaybackPosition first(path_, kLog);
    first.write({41, time_from_seconds(5004.1), 2});
    first.write(kMark);
    first.write(kMark);
  }
  PlaybackPosition second(path_, kLog);
  EXPECT_EQ(second.found(), kMark);
  second.write({43, time_from_seconds(5004.3), 2});
  EXPECT_EQ(PlaybackPosition(path_, kLog).found()->taken, 43U);
}

TEST_F(PlaybackPositionTest, AMarkInAnotherLogDoesNotCount) {
  PlaybackPosition(path_, kLog).write(kMark);
  PlaybackPosition::Log other = kLog;
  other.end += std::chrono::nanoseconds(1);
  EXPECT_FALSE(PlaybackPosition(path_, other).found());
  EXPECT_EQ(PlaybackPosition(path_, kLog).found(), kMark) << "looking at it changed nothing";
}

TEST_F(PlaybackPositionTest, ALogPlayedToItsEndIsForgotten) {
  PlaybackPosition position(path_, kLog);
  position.write(kMark);
  position.forget();
  EXPECT_FALSE(std::filesystem::exists(path_));
  position.write(kMark);
  EXPECT_FALSE(std::filesystem::exists(path_));
}

}  // namespace
}  // namespace coop::carmen
