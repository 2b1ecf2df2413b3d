#include "camera_driver/node/camera_driver_node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sensor_msgs/msg/CameraInfo.h>
#include <sensor_msgs/msg/Image.h>
#include <vision_msgs/msg/Detection3DArray.h>

#include <fstream>
#include <opencv2/imgproc.hpp>

#include "conversions/detections.hpp"
#include "conversions/image.hpp"
#include "conversions/time.hpp"
#include "core/atomic_file.hpp"
#include "core/config/error.hpp"
#include "core/image/picture_file.hpp"
#include "core/robot/robot_model.hpp"
#include "core/world/shapes.hpp"
#include "support/component_fixture.hpp"
#include "support/simulated_world.hpp"
#include "support/temporary_folder.hpp"

namespace coop::camera_driver {
namespace {

using namespace std::chrono_literals;
using runtime::Health;
using runtime::Qos;
using vision_msgs::msg::Detection3DArray;

class CameraDriverNodeTest : public testing::Test {
 protected:
  CameraDriverNodeTest() {
    config_.robot = std::string(COOP_SOURCE_DIR) + "/config/robot/egg_collector.urdf";
    eggs_ = fixture_.collect<Detection3DArray>("eggs", Qos::kEvent);
    fixture_.add<CameraDriverNode>("camera_driver", config_);
    simulator_.scene.robot_in_world = {4.0, 1.5, 0.0};
  }

  void lay_egg(double x, double y) {
    simulator_.scene.eggs.push_back(
        {"egg_1", {x, y, world::kEggHalfWidth}, world::EggState::kOnFloor});
  }

  CameraDriverConfig config_;
  coop::test::ComponentFixture fixture_;
  coop::test::SimulatedWorld simulator_{fixture_};
  std::shared_ptr<std::vector<Detection3DArray>> eggs_;
};

TEST_F(CameraDriverNodeTest, tells_where_an_egg_lies_at_the_stamp_of_the_frame) {
  (void)fixture_.tester().transforms();
  lay_egg(5.5, 1.4);
  simulator_.publish_world();
  simulator_.publish_truth(1s);
  ASSERT_EQ(eggs_->size(), 5U);
  const auto seen = conversions::from_msg(eggs_->back()).value();
  EXPECT_EQ(seen.frame_id, "camera_optical_frame");
  EXPECT_EQ(to_nanoseconds(seen.stamp) % 200'000'000, 0);
  ASSERT_EQ(seen.value.size(), 1U);
  EXPECT_EQ(seen.value[0].class_id, "egg");
  const auto camera_in_base =
      fixture_.tester().transforms().lookup("base_link", "camera_optical_frame", seen.stamp);
  ASSERT_TRUE(camera_in_base.has_value());
  const Eigen::Vector3d egg_in_base = *camera_in_base * seen.value[0].position;
  EXPECT_NEAR(egg_in_base.x(), 1.5, 0.02);
  EXPECT_NEAR(egg_in_base.y(), -0.1, 0.02);
  EXPECT_NEAR(egg_in_base.z(), world::kEggHalfWidth, 0.02);
}

/// Places of one egg in base_link, as told by a camera with the errors of that seed.
std::vector<Eigen::Vector3d> places_told(CameraDriverConfig config, std::uint64_t seed,
                                         const PlacementErrorConfig& errors, Duration duration) {
  coop::test::ComponentFixture fixture;
  coop::test::SimulatedWorld simulator(fixture);
  config.sim.errors = errors;
  const auto messages = fixture.collect<Detection3DArray>("eggs", Qos::kEvent);
  runtime::Options options;
  options.seed = seed;
  fixture.add<CameraDriverNode>("camera_driver", config, options);
  simulator.scene.robot_in_world = {4.0, 1.5, 0.0};
  simulator.scene.eggs = {{"egg_1", {5.5, 1.4, world::kEggHalfWidth}, world::EggState::kOnFloor}};
  simulator.publish_world();
  simulator.publish_truth(duration);
  const Pose3 camera_in_base =
      robot::RobotModel::load(config.robot).mount(robot::kCameraOpticalFrame);
  std::vector<Eigen::Vector3d> places;
  for (const auto& message : *messages) {
    const auto seen = conversions::from_msg(message).value();
    for (const Detection& egg : seen.value) {
      places.push_back(camera_in_base * egg.position);
    }
  }
  return places;
}

TEST_F(CameraDriverNodeTest, a_camera_mounted_askew_misplaces_every_egg_alike) {
  const PlacementErrorConfig askew{.mount_position = 0.0, .mount_angle = 0.03, .detection = 0.0};
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto places = places_told(config_, seed, askew, 1s);
    ASSERT_GE(places.size(), 4U);
    for (const auto& place : places) EXPECT_LT((place - places.front()).norm(), 0.03);
    squares += (places.front() - Eigen::Vector3d(1.5, -0.1, world::kEggHalfWidth)).squaredNorm();
  }
  // 0.03 rad about two axes across a ray of some 1.6 m.
  EXPECT_GT(std::sqrt(squares / 6), 0.02);
  EXPECT_LT(std::sqrt(squares / 6), 0.15);
}

TEST_F(CameraDriverNodeTest, the_error_of_a_detection_is_a_function_of_seed_and_stamp) {
  const PlacementErrorConfig scattered{
      .mount_position = 0.0, .mount_angle = 0.0, .detection = 0.02};
  const auto places = places_told(config_, 1, scattered, 8s);
  ASSERT_GE(places.size(), 35U);
  double squares = 0.0;
  for (const auto& place : places) {
    squares += (place - Eigen::Vector3d(1.5, -0.1, world::kEggHalfWidth)).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(places.size())), 0.02 * std::sqrt(3.0),
              0.008);
  EXPECT_EQ(places_told(config_, 1, scattered, 8s), places);
}

TEST_F(CameraDriverNodeTest, says_that_it_sees_none) {
  simulator_.publish_world();
  simulator_.publish_truth(400ms);
  ASSERT_EQ(eggs_->size(), 2U);
  EXPECT_TRUE(eggs_->front().detections().empty());
}

TEST_F(CameraDriverNodeTest, shows_pictures_depth_and_calibration_of_one_stamp) {
  const auto images = fixture_.collect<sensor_msgs::msg::Image>("camera/image", Qos::kSensorStream);
  const auto depths = fixture_.collect<sensor_msgs::msg::Image>("camera/depth", Qos::kSensorStream);
  const auto infos =
      fixture_.collect<sensor_msgs::msg::CameraInfo>("camera/camera_info", Qos::kSensorStream);
  simulator_.publish_world();
  simulator_.publish_truth(400ms);
  ASSERT_EQ(images->size(), 2U);
  ASSERT_EQ(depths->size(), 2U);
  ASSERT_EQ(infos->size(), 2U);
  const auto image = conversions::from_msg(images->back()).value();
  const auto depth = conversions::from_msg(depths->back()).value();
  const auto& info = infos->back();
  EXPECT_EQ(image.encoding, "rgb8");
  EXPECT_EQ(depth.encoding, "16UC1");
  EXPECT_EQ(image.pixels.size(), cv::Size(424, 240));
  EXPECT_EQ(depth.pixels.size(), cv::Size(424, 240));
  EXPECT_EQ(info.width(), 424U);
  EXPECT_EQ(image.stamp, depth.stamp);
  EXPECT_EQ(image.stamp, *conversions::from_msg(info.header().stamp()));
  // The floor where the axis meets it, 0.75 m below the camera, 0.62 rad down: 0.75 / sin 0.62.
  const auto on_axis =
      depth.pixels.at<std::uint16_t>(static_cast<int>(info.k()[5]), static_cast<int>(info.k()[2]));
  EXPECT_NEAR(on_axis, 1291, 30);
}

TEST_F(CameraDriverNodeTest, is_ready_with_the_simulator_and_degraded_without) {
  fixture_.advance(1s);
  EXPECT_EQ(fixture_.node_of("camera_driver").health(), Health::kDegraded);
  simulator_.publish_world();
  simulator_.publish_truth(200ms);
  EXPECT_EQ(fixture_.node_of("camera_driver").health(), Health::kReady);
}

TEST_F(CameraDriverNodeTest, one_that_started_late_sees_the_same) {
  lay_egg(5.5, 1.4);
  simulator_.publish_world();
  simulator_.publish_truth(300ms);
  fixture_.add<CameraDriverNode>("late", config_);
  eggs_->clear();
  simulator_.publish_truth(400ms);
  ASSERT_EQ(eggs_->size(), 4U);
  EXPECT_EQ((*eggs_)[0], (*eggs_)[1]);
  EXPECT_EQ((*eggs_)[2], (*eggs_)[3]);
}

TEST(OverheadBackend, tells_of_pigs_and_manure_in_the_map) {
  coop::test::ComponentFixture fixture;
  coop::test::SimulatedWorld simulator(fixture);
  CameraDriverConfig config;
  config.backend = "overhead";
  config.robot = std::string(COOP_SOURCE_DIR) + "/config/robot/pen_cleaner.urdf";
  const auto animals = fixture.collect<Detection3DArray>("animals", Qos::kEvent);
  const auto manure = fixture.collect<Detection3DArray>("manure", Qos::kEvent);
  const auto pictures =
      fixture.collect<sensor_msgs::msg::Image>("camera/image", Qos::kSensorStream);
  fixture.add<CameraDriverNode>("camera_driver", config);
  simulator.world = coop::test::room(50, 30);
  simulator.scene.robot_in_world = {0.5, 0.5, 0.0};
  simulator.scene.heaps = {{"heap", {3.0, 1.0}, 0.07, world::HeapState::kOnFloor}};
  simulator.scene.animals = {{"pig", {2.0, 2.0}, {0, 0}, 0.25}};
  simulator.publish_world();
  simulator.publish_truth(1s);
  ASSERT_EQ(manure->size(), 5U);
  const auto heaps = conversions::from_msg(manure->back()).value();
  EXPECT_EQ(heaps.frame_id, "map");
  ASSERT_EQ(heaps.value.size(), 1U);
  EXPECT_EQ(heaps.value[0].class_id, "manure");
  EXPECT_NEAR(heaps.value[0].position.x(), 3.0, 0.02);
  EXPECT_NEAR(heaps.value[0].position.y(), 1.0, 0.02);
  const auto pigs = conversions::from_msg(animals->back()).value();
  ASSERT_EQ(pigs.value.size(), 1U);
  EXPECT_EQ(pigs.value[0].class_id, "pig");
  EXPECT_NEAR(pigs.value[0].position.x(), 2.0, 0.06);
  ASSERT_FALSE(pictures->empty());
  EXPECT_EQ(pictures->back().header().frame_id(), "overhead_camera_optical_frame");

  simulator.scene.heaps[0].state = world::HeapState::kCleaned;
  simulator.publish_truth(1s);
  EXPECT_TRUE(conversions::from_msg(manure->back()).value().value.empty()) << "it says so";
}

TEST(FilesBackend, shows_each_picture_of_a_folder_with_its_eggs_and_ends) {
  const coop::test::TemporaryFolder folder;
  cv::Mat picture(400, 800, CV_8UC3, cv::Scalar(90, 90, 90));
  write_file_atomically(folder.path() / "1_empty.png", encode_png(picture));
  cv::ellipse(picture, {400, 200}, {25, 20}, 0, 0, 360, {120, 150, 200}, cv::FILLED, cv::LINE_AA);
  write_file_atomically(folder.path() / "2_egg.png", encode_png(picture));
  std::ofstream(folder.path() / "3_broken.png") << "no picture";
  CameraDriverConfig config;
  config.backend = "files";
  config.robot = std::string(COOP_SOURCE_DIR) + "/config/robot/egg_collector.urdf";
  config.files.folder = folder.path().string();
  coop::test::ComponentFixture fixture;
  const auto eggs = fixture.collect<Detection3DArray>("eggs", Qos::kEvent);
  const auto images = fixture.collect<sensor_msgs::msg::Image>("camera/image", Qos::kSensorStream);
  fixture.add<CameraDriverNode>("camera_driver", config);
  fixture.advance(5s, 500ms);
  ASSERT_EQ(eggs->size(), 2U);
  EXPECT_EQ(images->size(), 2U);
  EXPECT_TRUE((*eggs)[0].detections().empty());
  EXPECT_EQ((*eggs)[1].detections().size(), 1U);
  EXPECT_TRUE(fixture.node_of("camera_driver").wants_to_end());
  EXPECT_EQ(fixture.node_of("camera_driver").exit_code(), 0);
}

TEST(CameraDriverNodeCheck, refuses_a_folder_without_pictures) {
  CameraDriverConfig config;
  config.backend = "files";
  config.files.folder = "no/such/folder";
  EXPECT_THAT([&] { CameraDriverNode::check(config); },
              testing::ThrowsMessage<config::Error>(testing::HasSubstr("files.folder")));
}

TEST(CameraDriverNodeCheck, refuses_a_robot_that_is_not_there) {
  CameraDriverConfig config;
  config.robot = "no/such.urdf";
  EXPECT_ANY_THROW(CameraDriverNode::check(config));
}

}  // namespace
}  // namespace coop::camera_driver
