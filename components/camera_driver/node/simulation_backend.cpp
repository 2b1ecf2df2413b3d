#include "camera_driver/node/simulation_backend.hpp"

#include "camera_driver/node/camera_driver_node.hpp"

namespace coop::camera_driver {

SimulationBackend::SimulationBackend(runtime::Node& node, const CameraDriverConfig& config,
                                     const Pose3& camera_in_base)
    : detector_(config.detector,
                d435i_intrinsics(config.sim.camera.width, config.sim.camera.height),
                camera_in_base),
      topics_(node),
      feed_(node, config.sim.rate,
            {.world =
                 [this, &node, camera = config.sim.camera,
                  camera_in_base](const world::World& world) {
                   camera_.emplace(camera, world, camera_in_base, node.options().seed);
                 },
             .measure = [this](const world::GroundTruth& truth) { measure(truth); }}) {}

void SimulationBackend::measure(const world::GroundTruth& truth) {
  camera_->take(truth, frame_);
  topics_.publish(frame_, camera_->intrinsics());
  topics_.publish(frame_.stamp, detector_.detect(frame_));
}

}  // namespace coop::camera_driver
