#include "sequencer/camera_view.hpp"

#include <gtest/gtest.h>

#include "unit/sequencer/straight_down.hpp"

namespace coop::sequencer {
namespace {

using test::straight_down;

// The picture ends 0.5 m from its middle, less 0.1 m of margin.
const CameraViewConfig kConfig{.margin = 0.1, .distance = 1.8};

TEST(CameraView, ShowsAnEggThatIsWholeInThePicture) {
  const CameraView view = straight_down({2, 3});
  EXPECT_TRUE(view.shows({2, 3}, 0, kConfig));
  EXPECT_TRUE(view.shows({2.39, 3}, 0, kConfig));
  EXPECT_TRUE(view.shows({2, 2.61}, 0, kConfig));
}

TEST(CameraView, DoesNotShowAnEggAtItsBorderOrBeyond) {
  const CameraView view = straight_down({2, 3});
  EXPECT_FALSE(view.shows({2.41, 3}, 0, kConfig));
  EXPECT_FALSE(view.shows({2, 2.59}, 0, kConfig));
  EXPECT_FALSE(view.shows({1.4, 3}, 0, kConfig));
  EXPECT_FALSE(view.shows({2, 5}, 0, kConfig));
}

TEST(CameraView, APlaceNotKnownWellNeedsMoreRoom) {
  const CameraView view = straight_down({2, 3});
  EXPECT_TRUE(view.shows({2.3, 3}, 0.04, kConfig));
  EXPECT_FALSE(view.shows({2.3, 3}, 0.06, kConfig));
}

TEST(CameraView, AnEggFarAwayOrBehindIsNotShown) {
  CameraView view = straight_down({2, 3});
  view.camera_in_map.translation().z() = 1.9;
  EXPECT_FALSE(view.shows({2, 3}, 0, kConfig));
  view.camera_in_map.translation().z() = -1.0;
  EXPECT_FALSE(view.shows({2, 3}, 0, kConfig));
}

}  // namespace
}  // namespace coop::sequencer
