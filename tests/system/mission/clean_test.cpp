// The cleaning robot in one of the eight pens as eight programs, in lockstep: all manure goes, and
// no pig is touched.
#include <gtest/gtest.h>

#include "system/mission/mission_watch.hpp"
#include "system/support/running_system.hpp"

namespace coop::test {
namespace {

constexpr std::chrono::minutes kMissionLimit{10};
constexpr int kHeaps = 5;

class CleaningSystem : public ::testing::Test {
 protected:
  void start(const std::vector<std::string>& arguments) {
    system_.emplace(std::filesystem::path(COOP_SOURCE_DIR) / "tests/data/pig_pen_lockstep.yaml",
                    arguments);
    watch_.emplace(system_->domain());
  }
  bool wait(const std::function<bool()>& condition) {
    return look_until(*watch_, condition, kMissionLimit);
  }
  void expect_a_clean_pen() {
    ASSERT_TRUE(wait([&] { return watch_->is_done(); })) << watch_->mission().detail();
    EXPECT_TRUE(wait([&] { return watch_->heaps_cleaned() == kHeaps; }));
    EXPECT_GE(watch_->mission().eggs().size(), static_cast<std::size_t>(kHeaps));
    EXPECT_EQ(watch_->eggs_picked(), static_cast<int>(watch_->mission().eggs().size()))
        << "every heap is accounted for";
    EXPECT_EQ(watch_->truth().animal_collision_count(), 0U);
    EXPECT_EQ(watch_->truth().collision_count(), 0U);
  }
  std::optional<RunningSystem> system_;
  std::optional<MissionWatch> watch_;
};

TEST_F(CleaningSystem, AllHeapsOfAPenAreCleanedAndNoPigIsTouched) {
  start({"--set", "pen=6"});
  expect_a_clean_pen();
}

TEST_F(CleaningSystem, ASequencerKilledOnTheWayGoesOnWithTheHeapsThatAreLeft) {
  start({"--seed", "2"});
  ASSERT_TRUE(wait([&] { return watch_->eggs_picked() >= 1; })) << watch_->mission().detail();
  const auto known = watch_->mission().eggs().size();
  system_->kill_component("sequencer");
  expect_a_clean_pen();
  EXPECT_GE(watch_->mission().eggs().size(), known);
  EXPECT_EQ(watch_->mission().mission_id(), "clean-1");
}

}  // namespace
}  // namespace coop::test
