#include "sequencer/egg_tracks.hpp"

#include <gtest/gtest.h>

#include "unit/sequencer/straight_down.hpp"

namespace coop::sequencer {
namespace {

Time at(double value) {
  return time_from_seconds(value);
}

Sighting sighting(double x, double y, double stddev = 0.05) {
  return {{x, y}, stddev * stddev * Eigen::Matrix2d::Identity(), 1.0};
}

class EggTracksTest : public ::testing::Test {
 protected:
  /// Pictures that do not tell what they show.
  void see(const std::vector<Sighting>& sightings, int times = 1) {
    for (int i = 0; i < times; ++i) tracks_.update({at(now_ += 0.2), sightings, {}});
  }
  /// Pictures of the square of 1 m around (2, 3).
  void look_down(const std::vector<Sighting>& sightings, int times = 1) {
    for (int i = 0; i < times; ++i) {
      tracks_.update({at(now_ += 0.2), sightings, test::straight_down({2, 3})});
    }
  }
  /// An egg at (2, 3), just picked.
  void pick_an_egg() {
    look_down({sighting(2, 3)}, 3);
    tracks_.mark_picked(tracks_.tracks().at(0).id, at(now_));
  }
  double now_ = 10;
  EggTracks tracks_{EggTracksConfig{}};
};

TEST_F(EggTracksTest, AnEggCountsAfterThreeSightings) {
  see({sighting(2, 3)}, 2);
  EXPECT_FALSE(tracks_.tracks().at(0).confirmed);
  see({sighting(2, 3)});
  EXPECT_TRUE(tracks_.tracks().at(0).confirmed);
}

TEST_F(EggTracksTest, TheMeanOfEquallyGoodSightingsIsTheEggsPlace) {
  see({sighting(2.00, 3)});
  see({sighting(2.04, 3)});
  ASSERT_EQ(tracks_.tracks().size(), 1U);
  EXPECT_NEAR(tracks_.tracks()[0].egg_in_map.x(), 2.02, 1e-3);
  // Two sightings of 5 cm and the floor of 2 cm: sqrt((0.05^2 + 0.02^2) / 2).
  EXPECT_NEAR(tracks_.tracks()[0].stddev(), 0.0381, 1e-3);
}

TEST_F(EggTracksTest, EggsHalfAMetreApartAreTwo) {
  see({sighting(2, 3), sighting(2.5, 3)}, 5);
  EXPECT_EQ(tracks_.tracks().size(), 2U);
}

TEST_F(EggTracksTest, AFlickerIsForgotten) {
  see({sighting(2, 3)});
  tracks_.update({at(now_ + 30), {}, {}});
  EXPECT_TRUE(tracks_.tracks().empty());
}

TEST_F(EggTracksTest, PicturesThatShowItsPlaceWithoutItAreCountedUntilItIsSeen) {
  look_down({sighting(2, 3)}, 3);
  EXPECT_EQ(tracks_.tracks()[0].seen_in_row, 3);
  look_down({}, 4);
  EXPECT_EQ(tracks_.tracks()[0].unseen_in_row, 4);
  EXPECT_EQ(tracks_.tracks()[0].seen_in_row, 0);
  look_down({sighting(2, 3)});
  EXPECT_EQ(tracks_.tracks()[0].unseen_in_row, 0);
}

TEST_F(EggTracksTest, PicturesThatDoNotShowItsPlaceSayNothingOfIt) {
  see({sighting(2.45, 3)}, 3);  // in a corner of what look_down() shows
  look_down({}, 4);
  see({}, 4);
  EXPECT_EQ(tracks_.tracks()[0].unseen_in_row, 0);
  EXPECT_EQ(tracks_.tracks()[0].seen_in_row, 3);
}

TEST_F(EggTracksTest, PicturesOfBeforeTheEndOfThePickAreItsEcho) {
  look_down({sighting(2, 3)}, 3);
  tracks_.mark_picked("egg1", at(now_ + 10));
  look_down({sighting(2, 3)}, 20);
  EXPECT_EQ(tracks_.tracks().size(), 1U);
}

TEST_F(EggTracksTest, AnEggThatLiesWhereOneWasPickedIsANewOneAfterFivePictures) {
  pick_an_egg();
  look_down({sighting(2, 3)}, 4);
  EXPECT_EQ(tracks_.tracks().size(), 1U);
  look_down({sighting(2, 3)});
  ASSERT_EQ(tracks_.tracks().size(), 2U);
  EXPECT_EQ(tracks_.tracks()[1].id, "egg2");
  EXPECT_TRUE(tracks_.tracks()[1].confirmed);
  EXPECT_FALSE(tracks_.tracks()[1].picked);
  look_down({sighting(2, 3)}, 10);
  EXPECT_EQ(tracks_.tracks().size(), 2U) << "later sightings are of the new one";
  EXPECT_EQ(tracks_.tracks()[1].seen_in_row, 11);
}

TEST_F(EggTracksTest, AFlickerWhereAnEggWasPickedIsNoEgg) {
  pick_an_egg();
  for (int i = 0; i < 10; ++i) {
    look_down({sighting(2, 3)}, 4);
    look_down({});
  }
  EXPECT_EQ(tracks_.tracks().size(), 1U);
}

TEST_F(EggTracksTest, AnEggLaidMuchLaterWhereOneWasPickedCounts) {
  pick_an_egg();
  look_down({}, 3);
  now_ += 600;
  look_down({sighting(2.03, 3.02)}, 5);
  ASSERT_EQ(tracks_.tracks().size(), 2U);
  tracks_.mark_picked("egg2", at(now_));
  look_down({sighting(2.03, 3.02)}, 5);
  EXPECT_EQ(tracks_.tracks().size(), 3U) << "and so does the one after it";
}

TEST_F(EggTracksTest, WeakOrBrokenDetectionsAreIgnored) {
  Sighting weak = sighting(1, 1);
  weak.score = 0.1;
  Sighting broken = sighting(std::nan(""), 1);
  see({weak, broken}, 3);
  EXPECT_TRUE(tracks_.tracks().empty());
}

TEST_F(EggTracksTest, ARestoredEggKeepsItsNameAndNewOnesGetOthers) {
  EggTrack known;
  known.id = "egg7";
  known.egg_in_map = {2, 3};
  known.covariance = 0.0025 * Eigen::Matrix2d::Identity();
  tracks_.restore(known);
  see({sighting(2.02, 3), sighting(5, 5)}, 3);
  ASSERT_EQ(tracks_.tracks().size(), 2U);
  EXPECT_EQ(tracks_.tracks()[0].id, "egg7");
  EXPECT_EQ(tracks_.tracks()[1].id, "egg8");
}

}  // namespace
}  // namespace coop::sequencer
