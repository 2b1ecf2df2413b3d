#include "runtime/pause_watch.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "unit/runtime/arrivals.hpp"

namespace coop::runtime {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

TEST(PauseDetector, takes_a_look_in_time_for_no_pause) {
  PauseDetector detector(seconds(4), seconds(100));
  EXPECT_FALSE(detector.look(seconds(104)));
  EXPECT_FALSE(detector.look(seconds(108)));
  EXPECT_FALSE(detector.take(seconds(200), seconds(0)));
}

TEST(PauseDetector, tells_a_longer_pause_once_and_with_its_length) {
  PauseDetector detector(seconds(4), seconds(100));
  EXPECT_TRUE(detector.look(seconds(105)));
  EXPECT_FALSE(detector.look(seconds(106)));
  EXPECT_EQ(detector.take(seconds(200), seconds(0)), seconds(5));
  EXPECT_FALSE(detector.take(seconds(200), seconds(0)));
}

TEST(PauseDetector, tells_the_longest_of_several_pauses) {
  PauseDetector detector(seconds(4), seconds(0));
  detector.look(seconds(60));
  detector.look(seconds(65));
  EXPECT_EQ(detector.take(seconds(200), seconds(0)), seconds(60));
}

TEST(PauseDetector, keeps_a_pause_until_the_rest_since_its_beginning_is_over) {
  PauseDetector detector(seconds(4), seconds(100));
  EXPECT_TRUE(detector.look(seconds(105)));
  EXPECT_FALSE(detector.take(seconds(105), seconds(6)));
  EXPECT_TRUE(detector.has_pause());
  EXPECT_EQ(detector.take(seconds(106), seconds(6)), seconds(5));
  EXPECT_FALSE(detector.has_pause());
}

TEST(PauseDetector, is_not_misled_by_two_threads_that_look_in_the_other_order) {
  PauseDetector detector(seconds(4), seconds(0));
  EXPECT_FALSE(detector.look(seconds(3)));
  EXPECT_FALSE(detector.look(seconds(1)));
  EXPECT_FALSE(detector.look(seconds(6)));
}

TEST(PauseWatch, goes_by_a_clock_that_counts_while_the_machine_is_suspended) {
  const nanoseconds steady = std::chrono::steady_clock::now().time_since_epoch();
  EXPECT_GE(PauseWatch::machine_time(), steady);
}

/// A clock that the test sets.
class WatchedPauses : public ::testing::Test {
 protected:
  /// Once the watch has looked at the time that is set.
  bool is_seen() {
    const int before = looks_;
    return pauses_.wait_until([&] { return looks_ >= before + 2; });
  }
  std::atomic<nanoseconds> now_{seconds(50)};
  std::atomic<int> looks_ = 0;
  std::atomic<int> told_ = 0;
  Arrivals pauses_;
  PauseWatch watch_{milliseconds(40), milliseconds(60),
                    [this] {
                      ++told_;
                      pauses_.callback()();
                    },
                    [this] {
                      ++looks_;
                      return now_.load();
                    }};
};

TEST_F(WatchedPauses, are_none_while_only_the_thread_that_works_does_not_look) {
  for (int i = 0; i < 20; ++i) {
    now_ = now_.load() + milliseconds(30);
    ASSERT_TRUE(is_seen());
  }
  EXPECT_FALSE(watch_.take());
  EXPECT_EQ(told_, 0);
}

TEST_F(WatchedPauses, are_told_by_the_watch_itself_where_nobody_asks) {
  ASSERT_TRUE(is_seen());
  now_ = now_.load() + milliseconds(7000);
  ASSERT_TRUE(pauses_.wait_until([&] { return told_ > 0; }));
  EXPECT_EQ(watch_.take(), milliseconds(7000));
}

}  // namespace
}  // namespace coop::runtime
