#include "conversions/mission.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace coop::conversions {
namespace {

namespace Constants = coop_msgs::msg::EggStatus_Constants;

coop_msgs::msg::EggStatus egg(std::uint8_t state, double x) {
  coop_msgs::msg::EggStatus status;
  status.state(state);
  status.position().x(x);
  status.position().y(2.0);
  return status;
}

TEST(UncollectedEggs, are_all_that_are_not_picked) {
  coop_msgs::msg::MissionStatus message;
  message.eggs({egg(Constants::PICKED, 1.0), egg(Constants::QUEUED, 3.0),
                egg(Constants::FAILED, 4.0),
                egg(Constants::SEEN, std::numeric_limits<double>::quiet_NaN())});
  const auto spots = uncollected_eggs(message, 0.05);
  ASSERT_EQ(spots.size(), 2U);
  EXPECT_EQ(spots[0], (Spot{{3.0, 2.0}, 0.05}));
  EXPECT_EQ(spots[1], (Spot{{4.0, 2.0}, 0.05}));
}

}  // namespace
}  // namespace coop::conversions
