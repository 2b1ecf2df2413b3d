// The bag of a real robot is played into slam, and on the map that comes of it into amcl.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>

#include "capture/mcap/reader.hpp"
#include "conversions/geometry.hpp"
#include "core/map/map_file.hpp"
#include "experiments/slam/relations.hpp"
#include "geometry_msgs/msg/PoseWithCovarianceStamped.h"
#include "runtime/raw_message.hpp"
#include "slam/trajectory_file.hpp"
#include "support/shared_data.hpp"
#include "system/capture/capture_support.hpp"

namespace coop::test {
namespace {

constexpr std::chrono::minutes kRunLimit{5};
/// A real floor of 2022: a small round robot stands, then drives eight metres and turns.
constexpr const char* kBag = "ros2/bags/macfirst_floor_take_2";

/// Area of the cells that a map calls free, m2.
double free_area(const std::filesystem::path& yaml) {
  const auto map = map::load_map(yaml);
  const auto free = std::ranges::count(map.cells, kFree);
  return static_cast<double>(free) * map.geometry.resolution * map.geometry.resolution;
}

/// What amcl said, in the order in which it did.
std::vector<Stamped<PoseEstimate>> poses_in(const std::filesystem::path& capture) {
  std::vector<Stamped<PoseEstimate>> poses;
  mcap::Reader reader(capture);
  auto cursor = reader.messages({.topics = {"/amcl_pose"}});
  while (const auto read = cursor.next()) {
    const auto* data = reinterpret_cast<const std::uint8_t*>(read->message.data.data());
    geometry_msgs::msg::PoseWithCovarianceStamped message;
    EXPECT_TRUE(runtime::from_wire({data, data + read->message.data.size()}, message));
    const auto pose = conversions::from_msg(message);
    EXPECT_TRUE(pose) << pose.error();
    if (pose) poses.push_back(*pose);
  }
  return poses;
}

class RealBag : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto bag = shared_data(kBag);
    if (!bag) GTEST_SKIP() << "not run: no recorded bag";
    if (folder_) return;
    folder_ = std::make_unique<TemporaryFolder>();
    Program import("mcap", {"import", bag->string(), "-o", capture().string()},
                   folder_->path() / "out");
    const auto imported = import.wait();
    ASSERT_TRUE(imported && imported->clean()) << import.output();
    play_into(
        fmt::format("  slam:\n    stop_timeout: 60\n"
                    "    parameters: {{save_path: \"{}\", scan_timeout: 0, session: \"\"}}\n",
                    map().string()));
  }
  static void TearDownTestSuite() { folder_.reset(); }

  /// Its map and trajectory, without ending.
  static std::filesystem::path map() { return folder_->path() / "map"; }
  static std::filesystem::path capture() { return folder_->path() / "bag.mcap"; }

  static std::unique_ptr<RunningSystem> play_into(const std::string& components) {
    const LaunchText launch(fmt::format(
        "use_sim_time: true\nlockstep: true\ncomponents:\n{}"
        "  play: {{time: system, on_exit: shutdown, parameters: {{file: \"{}\", rate: 0}}}}\n",
        components, capture().string()));
    auto system = std::make_unique<RunningSystem>(launch.path());
    const auto status = system->launcher().wait(kRunLimit);
    EXPECT_TRUE(status && status->clean()) << system->launcher().output();
    return system;
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(RealBag, BecomesAMap) {
  EXPECT_GT(free_area(map().string() + ".yaml"), 20.0);
}

TEST_F(RealBag, IsFollowedByAmclOnItsMap) {
  const auto file = map().string() + "_trajectory.txt";
  const auto way = slam::parse_trajectory(read_file(file), file);
  ASSERT_FALSE(way.empty());
  const Pose2 begin = way.front().pose;
  const auto system =
      play_into(fmt::format("  record: {{}}\n"
                            "  amcl:\n    parameters: {{map_file: \"{}.yaml\", initial_pose: {{x: "
                            "{}, y: {}, yaw: {}}}}}\n",
                            map().string(), begin.x, begin.y, begin.yaw));
  const auto files = captures_of(system->folder() / "runs/latest");
  ASSERT_EQ(files.size(), 1U);
  const auto poses = poses_in(files[0]);
  ASSERT_FALSE(poses.empty());
  double sum = 0.0;
  double worst = 0.0;
  double worst_turn = 0.0;
  double driven = 0.0;
  for (const auto& pose : poses) {
    const Pose2 expected = experiments::pose_at(way, pose.stamp);
    const double error = distance(pose.value.pose, expected);
    sum += error;
    worst = std::max(worst, error);
    worst_turn =
        std::max(worst_turn, std::abs(angle_difference(pose.value.pose.yaw, expected.yaw)));
  }
  for (std::size_t i = 1; i < poses.size(); ++i) {
    driven += distance(poses[i - 1].value.pose, poses[i].value.pose);
  }
  const double mean = sum / static_cast<double>(poses.size());
  std::printf(
      "%zu poses over %.1f m: %.3f m from slam's way on average, %.3f m and %.3f rad at most\n",
      poses.size(), driven, mean, worst, worst_turn);
  EXPECT_GT(poses.size(), 100U);
  EXPECT_GT(driven, 7.0);
  EXPECT_LT(mean, 0.08);
  EXPECT_LT(worst, 0.25);
  EXPECT_LT(worst_turn, 0.2);
}

}  // namespace
}  // namespace coop::test
