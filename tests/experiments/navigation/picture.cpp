#include "experiments/navigation/picture.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace coop::test {
namespace {

constexpr int kPixelsPerCell = 4;

class Canvas {
 public:
  explicit Canvas(const OccupancyGrid& house)
      : geometry_(house.geometry),
        image_(geometry_.height * kPixelsPerCell, geometry_.width * kPixelsPerCell, CV_8UC3,
               cv::Scalar(255, 255, 255)) {
    for (std::size_t i = 0; i < house.cells.size(); ++i) {
      if (house.cells[i] < kOccupied) continue;
      const Cell cell = geometry_.cell_at(i);
      cv::rectangle(
          image_,
          cv::Rect(cell.x * kPixelsPerCell, (geometry_.height - 1 - cell.y) * kPixelsPerCell,
                   kPixelsPerCell, kPixelsPerCell),
          cv::Scalar(60, 60, 60), cv::FILLED);
    }
  }

  [[nodiscard]] cv::Point at(const Eigen::Vector2d& point) const {
    const double scale = kPixelsPerCell / geometry_.resolution;
    return {static_cast<int>((point.x() - geometry_.origin.x()) * scale),
            image_.rows - static_cast<int>((point.y() - geometry_.origin.y()) * scale)};
  }
  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const cv::Scalar& color,
            int width = 1) {
    cv::line(image_, at(a), at(b), color, width, cv::LINE_AA);
  }
  void path(const std::vector<Pose2>& poses, const cv::Scalar& color) {
    for (std::size_t i = 1; i < poses.size(); ++i) {
      line(poses[i - 1].position(), poses[i].position(), color);
    }
  }
  void robot(const ExperimentRobot& robot, const Pose2& pose, const cv::Scalar& color) {
    for (std::size_t i = 0; i < robot.footprint.size(); ++i) {
      line(pose * robot.footprint[i], pose * robot.footprint[(i + 1) % robot.footprint.size()],
           color);
    }
    line(pose.position(), pose * Eigen::Vector2d(0.77, 0.0), color);
  }
  void disc(const Eigen::Vector2d& center, double radius, const cv::Scalar& color) {
    cv::circle(image_, at(center), static_cast<int>(radius / geometry_.resolution * kPixelsPerCell),
               color, cv::FILLED, cv::LINE_AA);
  }
  void save(const std::string& file) const { cv::imwrite(file, image_); }

 private:
  GridGeometry geometry_;
  cv::Mat image_;
};

}  // namespace

void draw_run(const std::string& file, const ClosedLoopConfig& config, const OccupancyGrid& house,
              const EggTask& task, const RunResult& result) {
  const ExperimentRobot robot;
  Canvas canvas(house);
  for (const Eigen::Vector3d& disc : config.new_obstacles) {
    canvas.disc(disc.head<2>(), disc.z(), cv::Scalar(120, 120, 200));
  }
  for (const auto& plan : result.plans_made) canvas.path(plan, cv::Scalar(160, 220, 160));
  for (std::size_t i = 0; i < result.moments.size(); i += 20) {
    canvas.robot(robot, result.moments[i].robot, cv::Scalar(200, 200, 200));
  }
  for (std::size_t i = 1; i < result.moments.size(); ++i) {
    const bool back = result.moments[i].velocity.v < 0.0;
    canvas.line(result.moments[i - 1].robot.position(), result.moments[i].robot.position(),
                back ? cv::Scalar(200, 0, 200) : cv::Scalar(200, 80, 0), 2);
  }
  canvas.disc(task.egg, 0.05, cv::Scalar(0, 140, 255));
  for (const Pose2& goal : result.goals_sent) canvas.robot(robot, goal, cv::Scalar(0, 0, 255));
  canvas.robot(robot, task.start, cv::Scalar(0, 160, 0));
  if (!result.moments.empty()) {
    canvas.robot(robot, result.moments.back().robot, cv::Scalar(0, 0, 0));
  }
  canvas.save(file);
}

}  // namespace coop::test
