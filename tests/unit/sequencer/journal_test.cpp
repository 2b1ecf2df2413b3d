#include "sequencer/journal.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace coop::sequencer {
namespace {

MissionState state_with(int picked) {
  MissionState state;
  state.mission_id = "collect-1";
  state.phase = MissionPhase::kDriving;
  state.waypoints = {{"gate \"north\"", {1, 2, 0.5}}};
  state.order = {"egg1", "egg2"};
  state.pick_id = "collect-1/egg1/1";
  state.has_home = true;
  for (int i = 0; i < 3; ++i) {
    EggTask egg;
    egg.id = "egg" + std::to_string(i + 1);
    egg.egg_in_map = {0.1 * i, 1.0 / 3.0};
    egg.phase = i < picked ? EggPhase::kPicked : EggPhase::kQueued;
    egg.tried_headings = {0.25};
    egg.reason = "line\nbreak";
    state.eggs.push_back(egg);
  }
  return state;
}

class JournalTest : public ::testing::Test {
 protected:
  coop::test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "mission.journal";
};

TEST_F(JournalTest, TheLastStateIsReadBackWhole) {
  {
    Journal journal(path_);
    EXPECT_TRUE(journal.append(state_with(0)));
    EXPECT_TRUE(journal.append(state_with(2)));
  }
  const auto state = Journal::read(path_);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->mission_id, "collect-1");
  EXPECT_EQ(state->count(EggPhase::kPicked), 2);
  EXPECT_EQ(state->waypoints[0].name, "gate \"north\"");
  EXPECT_EQ(state->waypoints[0].pose_in_map, (Pose2{1, 2, 0.5}));
  EXPECT_EQ(state->eggs[2].egg_in_map, Eigen::Vector2d(0.2, 1.0 / 3.0));
  EXPECT_EQ(state->eggs[1].tried_headings, std::vector<double>{0.25});
  EXPECT_EQ(to_line(*state), to_line(state_with(2)));
}

TEST_F(JournalTest, AStateWhoseTourCannotBeDrivenIsReadBackToo) {
  MissionState state = state_with(1);
  state.tour_cost = std::numeric_limits<double>::infinity();
  {
    Journal journal(path_);
    EXPECT_TRUE(journal.append(state_with(0)));
    EXPECT_TRUE(journal.append(state));
  }
  const auto read = Journal::read(path_);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->count(EggPhase::kPicked), 1);
  EXPECT_EQ(read->tour_cost, state.tour_cost);
}

TEST_F(JournalTest, CutAtAnyByteTheStateBeforeStands) {
  std::vector<std::size_t> ends;
  for (int picked = 0; picked <= 3; ++picked) {
    Journal journal(path_);
    ASSERT_TRUE(journal.append(state_with(picked)));
    ends.push_back(std::filesystem::file_size(path_));
  }
  const std::string whole = read_file(path_);
  const auto cut_path = folder_.path() / "cut";
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    const std::string_view cut = std::string_view(whole).substr(0, length);
    // The line break at a line's end may be missing: what it ends is whole without it.
    const auto complete =
        std::ranges::count_if(ends, [&](std::size_t end) { return length + 1 >= end; });
    const auto state = Journal::last_state(cut);
    ASSERT_EQ(state.has_value(), complete > 0) << "cut at byte " << length;
    if (state) {
      ASSERT_EQ(state->count(EggPhase::kPicked), complete - 1) << "cut at " << length;
    }
    // What is appended after the cut counts again.
    if (length % 100 == 0) {
      write_file_atomically(cut_path, cut);
      Journal journal(cut_path);
      ASSERT_TRUE(journal.append(state_with(3)));
      ASSERT_EQ(Journal::read(cut_path)->count(EggPhase::kPicked), 3) << "cut at " << length;
    }
  }
}

TEST_F(JournalTest, ADamagedByteIsNoticed) {
  Journal journal(path_);
  ASSERT_TRUE(journal.append(state_with(1)));
  ASSERT_TRUE(journal.append(state_with(2)));
  std::string content = read_file(path_);
  content[content.size() - 20] ^= 1;
  write_file_atomically(path_, content);
  EXPECT_EQ(Journal::read(path_)->count(EggPhase::kPicked), 1);
}

TEST_F(JournalTest, AFullDiskIsToldAndNothingIsLost) {
  Journal journal("/dev/full");
  EXPECT_FALSE(journal.append(state_with(1)));
}

TEST_F(JournalTest, WithoutAFileThereIsNoState) {
  EXPECT_FALSE(Journal::read(path_));
}

}  // namespace
}  // namespace coop::sequencer
