#include "core/robot/robot_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/config/error.hpp"
#include "support/shared_data.hpp"

namespace coop::robot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

RobotModel egg_collector() {
  return RobotModel::load(std::filesystem::path(COOP_SOURCE_DIR) /
                          "config/robot/egg_collector.urdf");
}

std::string error_of(const std::string& urdf) {
  try {
    (void)RobotModel::parse(urdf, "test.urdf");
  } catch (const config::Error& error) {
    return error.what();
  }
  return "no error";
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child) {
  return "<joint name='" + name + "' type='fixed'><parent link='" + parent + "'/><child link='" +
         child + "'/></joint>";
}

TEST(RobotModel, ReadsTheFootprintOfTheEggCollector) {
  const std::vector<Eigen::Vector2d> outline = egg_collector().footprint();
  ASSERT_EQ(outline.size(), 4U);
  double area = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % 4];
    area += 0.5 * (a.x() * b.y() - b.x() * a.y());
    EXPECT_NEAR(std::abs(a.y()), 0.28, 1e-9);
    EXPECT_NEAR(a.x(), a.x() > 0 ? 0.77 : -0.18, 1e-9);
  }
  EXPECT_NEAR(area, 0.95 * 0.56, 1e-9) << "positive: counter-clockwise";
}

TEST(RobotModel, DerivesTheAckermannGeometryFromKingpinsAndWheels) {
  const AckermannGeometry base = egg_collector().ackermann();
  EXPECT_NEAR(base.wheelbase, 0.55, 1e-9);
  EXPECT_NEAR(base.track, 0.48, 1e-9);
  EXPECT_NEAR(base.wheel_radius, 0.10, 1e-9);
  EXPECT_NEAR(base.max_steering_angle, 0.60, 1e-4);
  EXPECT_NEAR(base.max_steering_rate, 0.8, 1e-9);
  EXPECT_NEAR(base.min_turning_radius(), 0.804, 1e-3);
}

TEST(RobotModel, GivesTheMountsOfTheSensorsInBaseLink) {
  const RobotModel model = egg_collector();
  EXPECT_TRUE(model.mount(kLaserLink).translation().isApprox(Eigen::Vector3d(0.62, 0.0, 0.32)));
  EXPECT_TRUE(model.mount(kWorkingPoint).translation().isApprox(Eigen::Vector3d(0.92, 0.0, 0.0)));
  // The optical axis looks forward and 0.62 rad down, and x of the picture points to the robot's
  // right.
  const Pose3 optical_in_base = model.mount(kCameraOpticalFrame);
  EXPECT_TRUE(optical_in_base.linear().col(2).isApprox(
      Eigen::Vector3d(std::cos(0.62), 0.0, -std::sin(0.62)), 1e-9));
  EXPECT_TRUE(optical_in_base.linear().col(0).isApprox(-Eigen::Vector3d::UnitY(), 1e-9));
}

TEST(RobotModel, ListsTheArmFromBaseToCup) {
  const std::vector<Joint> arm = egg_collector().arm();
  ASSERT_EQ(arm.size(), 7U);
  EXPECT_EQ(arm.front().name, "arm_joint_1");
  EXPECT_EQ(arm[5].name, "arm_joint_6");
  EXPECT_FALSE(arm[6].is_movable());
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(arm[i].type, JointType::kRevolute);
    EXPECT_LT(arm[i].lower, 0.0);
    EXPECT_GT(arm[i].upper, 0.0);
    EXPECT_GT(arm[i].max_velocity, 0.0);
  }
}

TEST(RobotModel, RefusesAMountAcrossAMovingJoint) {
  const RobotModel model = egg_collector();
  EXPECT_THROW((void)model.mount(kSuctionCupLink), config::Error);
  EXPECT_THROW((void)model.mount("no_such_link"), config::Error);
}

TEST(RobotModel, TurnsARevoluteJointAboutItsAxis) {
  Joint hinge;
  hinge.type = JointType::kRevolute;
  hinge.axis = Eigen::Vector3d::UnitZ();
  hinge.origin.translation() << 1.0, 0.0, 0.0;
  const Pose3 quarter = hinge.child_in_parent(std::numbers::pi / 2);
  EXPECT_TRUE((quarter * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1, 1, 0), 1e-12));
}

TEST(RobotModel, RefusesALinkWithTwoParents) {
  const std::string error =
      error_of("<robot name='r'><link name='a'/><link name='b'/><link name='c'/>" +
               joint("ab", "a", "b") + joint("ac", "a", "c") + joint("bc", "b", "c") + "</robot>");
  EXPECT_THAT(error, StartsWith("test.urdf: "));
  EXPECT_THAT(error, HasSubstr("'c' has two parents"));
}

TEST(RobotModel, RefusesALoopBesideTheTree) {
  const std::string error =
      error_of("<robot name='r'><link name='a'/><link name='b'/><link name='c'/>" +
               joint("bc", "b", "c") + joint("cb", "c", "b") + "</robot>");
  EXPECT_THAT(error, HasSubstr("loop"));
}

TEST(RobotModel, NamesTheSecondRoot) {
  EXPECT_THAT(error_of("<robot name='r'><link name='a'/><link name='b'/></robot>"),
              HasSubstr("Two root links"));
}

TEST(RobotModel, RefusesEmptyAndBrokenText) {
  EXPECT_THAT(error_of(""), HasSubstr("empty"));
  EXPECT_THAT(error_of("<robot name='r'><link name='a'>"), StartsWith("test.urdf: "));
  EXPECT_THAT(error_of("not xml"), StartsWith("test.urdf: "));
}

TEST(RobotModel, RefusesSwappedJointLimits) {
  const std::string error = error_of(
      "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'>"
      "<parent link='a'/><child link='b'/><limit lower='1' upper='-1' effort='1' velocity='1'/>"
      "</joint></robot>");
  EXPECT_THAT(error, HasSubstr("'j' has its lower limit above"));
}

TEST(RobotModel, SaysWhichPartOfTheBaseIsMissing) {
  const RobotModel other =
      RobotModel::parse("<robot name='r'><link name='trunk'/></robot>", "o.urdf");
  EXPECT_THROW((void)other.footprint(), config::Error);
  const RobotModel bare =
      RobotModel::parse("<robot name='r'><link name='base_link'/></robot>", "b.urdf");
  EXPECT_THROW((void)bare.footprint(), config::Error);
  EXPECT_THROW((void)bare.ackermann(), config::Error);
}

TEST(RobotModel, NamesAFileThatDoesNotExist) {
  try {
    (void)RobotModel::load("/no/such/robot.urdf");
    FAIL() << "expected an error";
  } catch (const config::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/no/such/robot.urdf"));
  }
}

TEST(RobotModel, RefusesEveryMalformedFileInOneLine) {
  const auto folder = test::shared_data("urdf/malformed");
  if (!folder) GTEST_SKIP() << "not run: the shared data set is absent";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    ++files;
    try {
      (void)RobotModel::load(entry.path());
      ADD_FAILURE() << entry.path() << " was accepted";
    } catch (const config::Error& error) {
      EXPECT_THAT(error.what(), StartsWith(entry.path().string()));
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      EXPECT_GT(std::string(error.what()).size(), entry.path().string().size() + 10);
    }
  }
  EXPECT_GT(files, 5);
}

TEST(RobotModel, LoadsWellKnownRobots) {
  const auto folder = test::shared_data("urdf/robots");
  if (!folder) GTEST_SKIP() << "not run: the shared data set is absent";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    ++files;
    const RobotModel model = RobotModel::load(entry.path());
    EXPECT_EQ(model.joints().size() + 1, model.links().size()) << entry.path() << ": a tree";
  }
  EXPECT_GT(files, 3);
}

}  // namespace
}  // namespace coop::robot
