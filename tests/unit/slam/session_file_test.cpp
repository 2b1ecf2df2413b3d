#include "slam/session_file.hpp"

#include <gtest/gtest.h>

namespace coop::slam {
namespace {

/// Two tiles, one of them left of the origin; one cell hit, one passed.
Session example() {
  Session session;
  session.map = TileMap(0.1);
  session.map.writable_tile_at({3, 4}).at(3, 4).add_hit(0.02F, 0.07F);
  session.map.writable_tile_at({-40, 1}).at(-40, 1).add_pass();
  session.nodes = {{time_from_seconds(10.0), {1, 2, 0.5}, {0, 0, 0}},
                   {time_from_seconds(12.5), {2, 2, 0.6}, {1, 0.5, 0.1}}};
  session.base_in_track = {time_from_seconds(12.6), {2.1, 2, 0.6}};
  session.odom_in_track = {7, -3, 1};
  session.odometry_source = "01.0f.two";
  return session;
}

TEST(SessionFile, ComesBackToTheBit) {
  const Session before = example();
  const auto after = parse_session(to_bytes(before));
  ASSERT_TRUE(after) << after.error();
  EXPECT_EQ(after->map.resolution(), 0.1);
  EXPECT_EQ(after->map.tile_count(), 2U);
  const MapCell& hit = after->map.at({3, 4});
  EXPECT_EQ(hit.hits, 1);
  EXPECT_EQ(hit.visits, 1);
  EXPECT_EQ(hit.mean_x, 0.02F);
  EXPECT_EQ(hit.mean_y, 0.07F);
  EXPECT_EQ(after->map.at({-40, 1}).visits, 1);
  EXPECT_EQ(after->map.at({-40, 1}).hits, 0);
  EXPECT_FALSE(after->map.at({4, 4}).is_known());
  ASSERT_EQ(after->nodes.size(), 2U);
  EXPECT_EQ(after->nodes[1].stamp, before.nodes[1].stamp);
  EXPECT_EQ(after->nodes[1].base_in_odom, before.nodes[1].base_in_odom);
  EXPECT_EQ(after->nodes[1].base_in_map, before.nodes[1].base_in_map);
  EXPECT_EQ(after->base_in_track.stamp, before.base_in_track.stamp);
  EXPECT_EQ(after->base_in_track.pose, before.base_in_track.pose);
  EXPECT_EQ(after->odom_in_track, before.odom_in_track);
  EXPECT_EQ(after->odometry_source, before.odometry_source);
  EXPECT_EQ(to_bytes(*after), to_bytes(before));
}

TEST(SessionFile, KeepsOdometryAtTheScansAndTheNewest) {
  const auto track = track_of(example());
  ASSERT_EQ(track.size(), 3U);
  EXPECT_EQ(track[1].pose, (Pose2{2, 2, 0.6}));
  EXPECT_EQ(track[2].pose, (Pose2{2.1, 2, 0.6}));
}

TEST(SessionFile, ACutFileIsRefusedWhereverItWasCut) {
  const std::string whole = to_bytes(example());
  for (std::size_t length = 0; length < whole.size(); length += 7)
    EXPECT_FALSE(parse_session(std::string_view(whole).substr(0, length))) << length;
  EXPECT_FALSE(parse_session(std::string_view(whole).substr(0, whole.size() - 1)));
}

TEST(SessionFile, OneWrongByteIsFoundAnywhere) {
  const std::string whole = to_bytes(example());
  for (std::size_t i = 0; i < whole.size(); i += 11) {
    std::string altered = whole;
    altered[i] = static_cast<char>(altered[i] ^ 0x10);
    EXPECT_FALSE(parse_session(altered)) << i;
  }
}

TEST(SessionFile, ImpossibleNumbersAreRefusedThoughTheChecksumHolds) {
  Session session = example();
  session.nodes.clear();
  EXPECT_EQ(parse_session(to_bytes(session)).error(), "holds impossible numbers");
  session = example();
  session.nodes[0].base_in_map.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(parse_session(to_bytes(session)));
  session = example();
  session.map = TileMap(0.0);
  EXPECT_FALSE(parse_session(to_bytes(session)));
}

}  // namespace
}  // namespace coop::slam
