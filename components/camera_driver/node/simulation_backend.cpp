#include "camera_driver/node/simulation_backend.hpp"

#include "camera_driver/node/camera_driver_node.hpp"

namespace coop::camera_driver {
namespace {

Eigen::Vector3d normal_vector(RandomStream& stream, double deviation) {
  Eigen::Vector3d vector;
  for (double& value : vector) value = stream.normal(0.0, deviation);
  return vector;
}

/// Where the camera truly is: not quite where the robot's description has it.
Pose3 as_mounted(const Pose3& camera_in_base, const PlacementErrorConfig& errors,
                 RandomStream stream) {
  Pose3 error = Pose3::Identity();
  error.translation() = normal_vector(stream, errors.mount_position);
  const Eigen::Vector3d turn = normal_vector(stream, errors.mount_angle);
  if (turn.norm() > 0.0) {
    error.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
  return camera_in_base * error;
}

}  // namespace

SimulationBackend::SimulationBackend(runtime::Node& node, const CameraDriverConfig& config,
                                     const Pose3& camera_in_base)
    : seed_(node.options().seed),
      detection_error_(config.sim.errors.detection),
      detector_(config.detector,
                d435i_intrinsics(config.sim.camera.width, config.sim.camera.height),
                camera_in_base),
      topics_(node),
      feed_(node, config.sim.rate,
            {.world =
                 [this, &node, camera = config.sim.camera,
                  mounted = as_mounted(camera_in_base, config.sim.errors, node.random("mount"))](
                     const world::World& world) {
                   camera_.emplace(camera, world, mounted, node.options().seed);
                 },
             .measure = [this](const world::GroundTruth& truth) { measure(truth); }}) {}

void SimulationBackend::measure(const world::GroundTruth& truth) {
  camera_->take(truth, frame_);
  topics_.publish(frame_, camera_->intrinsics());
  std::vector<Detection> eggs = detector_.detect(frame_);
  displace(eggs, frame_.stamp);
  topics_.publish(frame_.stamp, std::move(eggs));
}

/// A function of seed and stamp alone, as the camera's own noise is.
void SimulationBackend::displace(std::vector<Detection>& eggs, Time stamp) const {
  if (detection_error_ <= 0.0) return;
  RandomStream stream(seed_, "camera/detection/" + std::to_string(to_nanoseconds(stamp)));
  for (Detection& egg : eggs) {
    egg.position += normal_vector(stream, detection_error_);
    egg.covariance += detection_error_ * detection_error_ * Eigen::Matrix3d::Identity();
  }
}

}  // namespace coop::camera_driver
