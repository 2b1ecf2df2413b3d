// camera_pictures <frames> [folder]: the simulated camera at random poses in the duck house. Prints
// how far and how well eggs are found; writes pictures with what was found drawn in.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "unit/camera_driver/comparison.hpp"
#include "unit/camera_driver/duck_house.hpp"

namespace coop::camera_driver {
namespace {

struct Ring {
  int visible = 0;
  int found = 0;
  double squared_error = 0.0;
  double worst = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double mahalanobis = 0.0;
};

void draw(const Frame& frame, const std::vector<Detection>& eggs, const Intrinsics& camera,
          const std::vector<Eigen::Vector3d>& truth, const std::string& path) {
  cv::Mat picture;
  cv::cvtColor(frame.colour, picture, cv::COLOR_RGB2BGR);
  cv::Mat depth;
  frame.depth.convertTo(depth, CV_8U, 255.0 / 5000.0);
  cv::applyColorMap(depth, depth, cv::COLORMAP_JET);
  cv::resize(picture, picture, {}, 3, 3, cv::INTER_NEAREST);
  cv::resize(depth, depth, {}, 3, 3, cv::INTER_NEAREST);
  const auto at = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector2d pixel = camera.project(point);
    return cv::Point(static_cast<int>(3 * pixel.x() + 1), static_cast<int>(3 * pixel.y() + 1));
  };
  for (const auto& egg : truth) {
    if (egg.z() > 0.1) cv::drawMarker(picture, at(egg), {255, 0, 0}, cv::MARKER_CROSS, 10);
  }
  for (const Detection& egg : eggs) {
    cv::circle(picture, at(egg.position), static_cast<int>(3 * 0.04 * camera.fx / egg.position.z()),
               {0, 0, 255}, 2);
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", egg.score);
    cv::putText(picture, text, at(egg.position) + cv::Point(14, -14), cv::FONT_HERSHEY_SIMPLEX, 0.5,
                {0, 0, 255});
  }
  cv::vconcat(picture, depth, picture);
  cv::imwrite(path, picture);
}

using Rings = std::map<int, Ring>;  ///< by half metres before base_link

void count(const test::SeenEgg& egg, Rings& rings) {
  if (!egg.visible) return;
  Ring& ring = rings[static_cast<int>(egg.in_base.head<2>().norm() / 0.5)];
  ++ring.visible;
  if (!egg.found) return;
  ++ring.found;
  const Eigen::Vector3d error = egg.found->position - egg.in_camera;
  ring.squared_error += error.squaredNorm();
  ring.worst = std::max(ring.worst, error.norm());
  ring.sum += error;
  ring.mahalanobis += error.dot(egg.found->covariance.inverse() * error);
}

void print(const Rings& rings) {
  for (const auto& [index, ring] : rings) {
    const Eigen::Vector3d mean = 1000.0 * ring.sum / std::max(1, ring.found);
    std::printf(
        "%.1f-%.1f m: %d of %d visible eggs found, rms error %.1f mm, worst %.1f mm, mean (%.1f "
        "%.1f %.1f) mm, squared error in covariances %.2f (1 is right)\n",
        0.5 * index, 0.5 * index + 0.5, ring.found, ring.visible,
        1000 * std::sqrt(ring.squared_error / std::max(1, ring.found)), 1000 * ring.worst, mean.x(),
        mean.y(), mean.z(), ring.mahalanobis / 3 / std::max(1, ring.found));
  }
}

world::Egg egg_before(const world::GroundTruth& truth, double x, int name) {
  const Eigen::Vector2d at = truth.robot_in_world * Eigen::Vector2d(x, 0.0);
  return {"egg_" + std::to_string(name),
          {at.x(), at.y(), world::kEggHalfWidth},
          world::EggState::kOnFloor};
}

/// Where, straight ahead on a free floor, eggs of all headings are found and whole in the picture.
void measure_straight_ahead() {
  constexpr double kWorkingPoint = 0.92;  // m
  constexpr int kHeadings = 8;
  world::World floor;
  floor.grid = OccupancyGrid({100, 60, 0.1, {0.0, 0.0}}, kFree);
  const Pose3 mount = test::camera_in_base();
  SimulatedCamera camera({}, floor, mount, 7);
  EggDetector detector({}, camera.intrinsics(), mount);
  world::GroundTruth truth;
  truth.robot_in_world = {2.0, 3.0, 0.0};
  std::optional<double> first;
  double last = 0.0;
  Frame frame;
  for (int step = 0; step <= 160; ++step) {
    const double x = 0.80 + 0.02 * step;
    const bool is_working_point = std::abs(x - kWorkingPoint) < 1e-9;
    int found = 0;
    double score = 1.0;
    for (int i = 0; i < kHeadings; ++i) {
      truth.stamp = time_from_seconds(1.0 + step + 0.1 * i);
      truth.eggs = {egg_before(truth, x, i)};
      camera.take(truth, frame);
      const auto eggs = detector.detect(frame);
      if (!eggs.empty()) score = std::min(score, eggs[0].score);
      found += eggs.size() == 1 ? 1 : 0;
    }
    if (found == kHeadings) {
      if (!first) first = x;
      last = x;
    }
    if (!is_working_point) continue;
    const Eigen::Vector3d egg = mount.inverse() * Eigen::Vector3d(x, 0.0, world::kEggHalfWidth);
    const Intrinsics& lens = camera.intrinsics();
    const double below = lens.height - lens.project(egg).y();
    std::printf(
        "working point: %d of %d found, lowest score %.2f, %.1f pixels to the border "
        "beyond the egg's edge\n",
        found, kHeadings, score, below - world::kEggHalfLength * lens.fy / egg.z());
  }
  std::printf("straight ahead: found from x = %.2f m to %.2f m\n", first.value_or(0.0), last);
}

void run(int frames, const std::optional<std::string>& folder) {
  constexpr double kNear = 2.5;  // m, eggs missed nearer than this are worth a picture
  constexpr int kOrdinaryPictures = 6;
  const world::World world = test::duck_house();
  const Pose3 mount = test::camera_in_base();
  SimulatedCamera camera({}, world, mount, 7);
  EggDetector detector({}, camera.intrinsics(), mount);
  RandomStream random(11, "scenes");
  Rings rings;
  std::size_t spurious = 0;
  Frame frame;
  for (int i = 0; i < frames; ++i) {
    const world::GroundTruth truth = test::random_scene(world, random);
    camera.take(truth, frame);
    const auto found = detector.detect(frame);
    const auto result = test::compare(truth, found, frame, camera.intrinsics(), mount);
    std::vector<Eigen::Vector3d> eggs;
    bool wrong = !result.spurious.empty();
    for (const test::SeenEgg& egg : result.eggs) {
      eggs.push_back(egg.in_camera);
      count(egg, rings);
      if (!egg.visible || egg.found || egg.in_base.x() > kNear) continue;
      wrong = true;
      std::printf("missed in frame %d: %.2f %.2f in base\n", i, egg.in_base.x(), egg.in_base.y());
    }
    spurious += result.spurious.size();
    for (const Detection& egg : result.spurious) {
      const Eigen::Vector3d in_base = mount * egg.position;
      std::printf("spurious in frame %d: %.2f %.2f %.3f in base, score %.2f\n", i, in_base.x(),
                  in_base.y(), in_base.z(), egg.score);
    }
    if (folder && (i < kOrdinaryPictures || wrong)) {
      draw(frame, found, camera.intrinsics(), eggs,
           *folder + (wrong ? "/wrong_" : "/frame_") + std::to_string(i) + ".png");
    }
  }
  print(rings);
  std::printf("%zu spurious in %d frames\n", spurious, frames);
}

}  // namespace
}  // namespace coop::camera_driver

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::atoi(argv[1]) : 200;
  coop::camera_driver::measure_straight_ahead();
  coop::camera_driver::run(frames, argc > 2 ? std::optional<std::string>(argv[2]) : std::nullopt);
  return 0;
}
