#pragma once
#include <memory>
#include <string>

#include "camera_driver/egg_detector.hpp"
#include "camera_driver/overhead_mount.hpp"
#include "camera_driver/pen_detector.hpp"
#include "camera_driver/photograph.hpp"
#include "camera_driver/simulated_camera.hpp"
#include "runtime/node.hpp"

namespace coop::camera_driver {

/// Errors of the eggs' places that the detector cannot know of. None by default.
struct PlacementErrorConfig {
  double mount_position = 0.0;  ///< m, deviation over runs of the camera's place, each axis
  double mount_angle = 0.0;     ///< rad, deviation over runs of its direction, about each axis
  double detection = 0.0;       ///< m, deviation of each detection's place, each axis

  void describe(config::Fields& fields);
};

struct SimulationConfig {
  double rate = 5.0;  ///< Hz, of simulated time
  PlacementErrorConfig errors;
  SimulatedCameraConfig camera;

  void describe(config::Fields& fields);
};

struct FilesConfig {
  std::string folder;   ///< of PNG and JPEG pictures, shown in the order of their names
  double period = 1.0;  ///< s between pictures
  PhotographConfig photograph;

  void describe(config::Fields& fields);
};

/// A camera above the simulated world instead of one on the robot.
struct OverheadConfig {
  double rate = 5.0;  ///< Hz, of simulated time
  OverheadMount mount;
  SensorNoiseConfig noise;
  PenDetectorConfig detector;

  void describe(config::Fields& fields);
};

struct CameraDriverConfig {
  std::string backend = "sim";  ///< "sim", "overhead" or "files"
  std::string robot = "config/robot/egg_collector.urdf";
  SimulationConfig sim;
  EggDetectorConfig detector;  ///< of pictures with depth (sim)
  OverheadConfig overhead;
  FilesConfig files;

  void describe(config::Fields& fields);
  void validate() const;
};

/// The camera driver as a component; where pictures come from is up to the backend.
class CameraDriverNode {
 public:
  using Config = CameraDriverConfig;
  /// Throws where the files that the backend needs cannot be used.
  static void check(const Config& config);

  CameraDriverNode(runtime::Node& node, const Config& config);

 private:
  std::shared_ptr<void> backend_;
};

}  // namespace coop::camera_driver
