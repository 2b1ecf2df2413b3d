// camera_pictures <frames> [folder]: the simulated camera at random poses in the duck house. Prints
// how far and how well eggs are found; writes pictures with what was found drawn in.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

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

/// Whole in the picture, and nothing nearer over its middle.
bool is_visible(const Eigen::Vector3d& egg, const Frame& frame, const Intrinsics& camera) {
  const Eigen::Vector2d pixel = camera.project(egg);
  const double margin = 0.034 * camera.fx / egg.z();
  if (egg.z() <= 0.1 || pixel.x() < margin || pixel.y() < margin ||
      pixel.x() > camera.width - 1 - margin || pixel.y() > camera.height - 1 - margin) {
    return false;
  }
  for (const int dx : {-1, 0, 1}) {
    for (const int dy : {-1, 0, 1}) {
      const int column = static_cast<int>(pixel.x() + 0.5 + dx * margin * 0.9);
      const int row = static_cast<int>(pixel.y() + 0.5 + dy * margin * 0.9);
      const auto depth = frame.depth.at<std::uint16_t>(row, column);
      if (depth != 0 && 0.001 * depth < egg.z() - 0.12) return false;
    }
  }
  return true;
}

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

void run(int frames, const std::optional<std::string>& folder) {
  const world::World world = test::duck_house();
  const Pose3 mount = test::camera_in_base();
  SimulatedCamera camera({}, world, mount, 7);
  EggDetector detector({}, camera.intrinsics(), mount);
  RandomStream random(11, "scenes");
  std::map<int, Ring> rings;
  int spurious = 0;
  Frame frame;
  for (int i = 0; i < frames; ++i) {
    const world::GroundTruth truth = test::random_scene(world, random);
    camera.take(truth, frame);
    const auto found = detector.detect(frame);
    std::vector<bool> used(found.size(), false);
    std::vector<Eigen::Vector3d> eggs;
    bool bad = false;
    for (const world::Egg& egg : truth.eggs) {
      const Eigen::Vector3d in_base = to_pose3(truth.robot_in_world).inverse() * egg.position;
      const Eigen::Vector3d in_camera = mount.inverse() * in_base;
      eggs.push_back(in_camera);
      std::optional<std::size_t> best;
      for (std::size_t k = 0; k < found.size(); ++k) {
        const double distance = (found[k].position - in_camera).norm();
        if (distance < 0.15 && (!best || distance < (found[*best].position - in_camera).norm())) {
          best = k;
        }
      }
      if (best) used[*best] = true;
      if (!is_visible(in_camera, frame, camera.intrinsics())) continue;
      Ring& ring = rings[static_cast<int>(in_base.head<2>().norm() / 0.5)];
      ++ring.visible;
      if (!best) {
        bad = bad || in_base.x() < 2.5;
        if (in_base.x() < 2.5) {
          std::printf("missed in frame %d: egg at %.2f %.2f in base\n", i, in_base.x(),
                      in_base.y());
        }
        continue;
      }
      ++ring.found;
      const Eigen::Vector3d error = found[*best].position - in_camera;
      ring.squared_error += error.squaredNorm();
      ring.worst = std::max(ring.worst, error.norm());
      ring.sum += error;
      ring.mahalanobis += error.dot(found[*best].covariance.inverse() * error);
    }
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (used[k]) continue;
      ++spurious;
      bad = true;
      const Eigen::Vector3d in_base = mount * found[k].position;
      std::printf("spurious in frame %d: %.2f %.2f %.3f in base, score %.2f\n", i, in_base.x(),
                  in_base.y(), in_base.z(), found[k].score);
    }
    if (folder && (i < 6 || (bad && i < 400))) {
      draw(frame, found, camera.intrinsics(), eggs,
           *folder + (bad ? "/bad_" : "/frame_") + std::to_string(i) + ".png");
    }
  }
  for (const auto& [index, ring] : rings) {
    const Eigen::Vector3d mean = ring.sum / std::max(1, ring.found);
    std::printf(
        "%.1f-%.1f m: %d of %d visible eggs found, rms error %.1f mm, worst %.1f mm, mean (%.1f "
        "%.1f %.1f) mm, NEES/3 %.2f\n",
        0.5 * index, 0.5 * index + 0.5, ring.found, ring.visible,
        1000 * std::sqrt(ring.squared_error / std::max(1, ring.found)), 1000 * ring.worst,
        1000 * mean.x(), 1000 * mean.y(), 1000 * mean.z(),
        ring.mahalanobis / 3 / std::max(1, ring.found));
  }
  std::printf("%d spurious in %d frames\n", spurious, frames);
}

}  // namespace
}  // namespace coop::camera_driver

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::atoi(argv[1]) : 200;
  coop::camera_driver::run(frames, argc > 2 ? std::optional<std::string>(argv[2]) : std::nullopt);
  return 0;
}
