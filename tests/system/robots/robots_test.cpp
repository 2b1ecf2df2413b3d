// Several robots on one machine, each with its own launcher, simulator, localisation, planner and
// dwa: two of other names on one domain, and one of the same name on another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "coop_msgs/msg/GroundTruth.h"
#include "core/atomic_file.hpp"
#include "geometry_msgs/msg/PoseStamped.h"
#include "system/support/listener.hpp"
#include "system/support/running_system.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

using coop_msgs::msg::GroundTruth;
using geometry_msgs::msg::PoseStamped;
using ::testing::HasSubstr;

constexpr milliseconds kPatience{60000};
constexpr double kDriven = 0.4;  // m
/// Standing still, its simulator moves a robot by nothing at all.
constexpr double kStill = 0.001;  // m

std::filesystem::path launch_file(const std::filesystem::path& folder) {
  const auto file = folder / "robot.yaml";
  write_file_atomically(file, "include: [" COOP_SOURCE_DIR
                              "/config/launch/sim.yaml]\n"
                              "components:\n"
                              "  record: {enabled: false}\n"
                              "  camera_driver: {enabled: false}\n"
                              "  arm_driver: {enabled: false}\n"
                              "  sequencer: {enabled: false}\n");
  return file;
}

/// A robot's programs, and somebody who belongs to it: sees where it is, and sends it places.
class Robot {
 public:
  Robot(const std::filesystem::path& file, const std::string& name, int domain)
      : system_(file, {"--robot", name}, domain),
        person_({.domain = domain, .participant_name = "person", .partition = name}) {
    person_.node().subscribe<GroundTruth>(
        "ground_truth", runtime::Qos::kSensorStream, [this](const GroundTruth& truth) {
          const auto& at = truth.robot().position();
          if (!seen_) begin_x_ = at.x(), begin_y_ = at.y();
          seen_ = true;
          driven_ = std::max(driven_, std::hypot(at.x() - begin_x_, at.y() - begin_y_));
        });
    goals_ = person_.node().advertise<PoseStamped>("goal_pose", runtime::Qos::kEvent);
  }
  [[nodiscard]] bool is_ready() {
    person_.look();
    return seen_ && goals_.subscribers() > 0 &&
           system_.launcher().output().find("all 5 components ready") != std::string::npos;
  }
  [[nodiscard]] std::string output() { return system_.launcher().output(); }
  void send_down_the_aisle() {
    PoseStamped goal;
    goal.header().frame_id("map");
    goal.pose().position().x(4.4);
    goal.pose().position().y(-0.2);
    goal.pose().orientation().w(1.0);
    goals_.publish(goal);
  }
  /// Greatest distance from where it stood at first.
  [[nodiscard]] double driven() {
    person_.look();
    return driven_;
  }

 private:
  RunningSystem system_;
  Listener person_;
  runtime::Publisher<PoseStamped> goals_;
  bool seen_ = false;
  double begin_x_ = 0.0;
  double begin_y_ = 0.0;
  double driven_ = 0.0;
};

TEST(RobotsTest, each_of_several_robots_on_one_machine_drives_by_its_own_commands_alone) {
  const TemporaryFolder folder;
  const auto file = launch_file(folder.path());
  std::vector<std::unique_ptr<Robot>> robots;
  robots.push_back(std::make_unique<Robot>(file, "ducky", test_domain()));
  robots.push_back(std::make_unique<Robot>(file, "piggy", test_domain()));
  robots.push_back(std::make_unique<Robot>(file, "ducky", another_test_domain()));
  for (const auto& robot : robots) {
    ASSERT_TRUE(wait_until([&] { return robot->is_ready(); }, kPatience)) << robot->output();
  }
  for (std::size_t sent = 0; sent < robots.size(); ++sent) {
    robots[sent]->send_down_the_aisle();
    EXPECT_TRUE(wait_until([&] { return robots[sent]->driven() > kDriven; }, kPatience))
        << "robot " << sent << ": " << robots[sent]->output();
    for (std::size_t other = sent + 1; other < robots.size(); ++other) {
      EXPECT_LT(robots[other]->driven(), kStill) << "robot " << other << ", sent: " << sent;
    }
  }
}

}  // namespace
}  // namespace coop::test
