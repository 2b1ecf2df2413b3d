#include "sequencer/egg_tracks.hpp"

#include <gtest/gtest.h>

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
  void see(const std::vector<Sighting>& sightings, int times = 1) {
    for (int i = 0; i < times; ++i) tracks_.update(sightings, at(now_ += 0.2));
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
  tracks_.update({}, at(now_ + 30));
  EXPECT_TRUE(tracks_.tracks().empty());
}

TEST_F(EggTracksTest, APickedEggAbsorbsItsEchoAndThenANewOneCounts) {
  see({sighting(2, 3)}, 3);
  const std::string id = tracks_.tracks()[0].id;
  tracks_.mark_picked(id, at(now_));
  see({sighting(2, 3)}, 5);
  EXPECT_EQ(tracks_.tracks().size(), 1U);
  now_ += 60;
  see({sighting(2, 3)}, 3);
  ASSERT_EQ(tracks_.tracks().size(), 2U);
  EXPECT_NE(tracks_.tracks()[1].id, id);
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
