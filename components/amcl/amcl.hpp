#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "amcl/beams.hpp"
#include "amcl/cluster.hpp"
#include "amcl/free_space.hpp"
#include "amcl/likelihood_field.hpp"
#include "amcl/motion_model.hpp"
#include "amcl/particle_set.hpp"
#include "amcl/recovery.hpp"
#include "amcl/resampler.hpp"
#include "core/config/fields.hpp"
#include "core/grid.hpp"
#include "core/pose_estimate.hpp"
#include "core/random.hpp"
#include "core/scan.hpp"

namespace coop::amcl {

struct AmclConfig {
  double update_distance = 0.05;  ///< m driven until the next scan is weighed in
  double update_angle = 0.05;     ///< rad turned until the next scan is weighed in
  int beams = 60;                 ///< of a scan, at most
  double max_range = 25.0;        ///< m, longer beams are not used
  int min_beams = 8;              ///< fewer usable beams say nothing
  double independent_beams =
      8.0;  ///< so many independent ones a scan's beams are worth while tracking
  double searching_beams =
      2.0;  ///< and while the pose is open, where deciding early is deciding wrongly
  double resample_share = 0.5;  ///< resample when the effective sample size falls below this share
  double localised_stddev = 0.4;  ///< m, the pose is known when the heaviest cluster is this tight
  double lost_stddev = 0.9;       ///< m, and no longer known when it has spread to this
  double localised_share = 0.6;   ///< and known only if that cluster holds this share of the weight
  double search_noise = 0.03;     ///< m and rad an update, spreads particles while the pose is open
  int settle_updates = 8;  ///< scans weighed in after the pose was found, even if the robot stands
  int standing_updates = 4;  ///< scans weighed in while the pose is open and the robot stands
  double searching_share =
      0.1;  ///< of the particles drawn anew at each update while the pose is open
  int scattered_particles = 100000;  ///< spread over free space for global localisation
  int recovery_candidates = 20000;   ///< poses tried against a scan to draw recovery particles from
  double plausible_speed = 3.0;  ///< m/s (and rad/s): odometry that jumps faster has been restarted
  ArcMotionConfig motion;
  LikelihoodFieldConfig field;
  KldConfig kld;
  RecoveryConfig recovery;

  void describe(config::Fields& fields);
  void validate() const;
};

/// Where the robot is after a scan.
struct Estimate {
  Time stamp{};
  PoseEstimate robot_in_map;
  Pose2 odom_in_map;           ///< takes odometry poses to the map
  bool localised = false;      ///< false: do not use the pose
  bool updated = false;        ///< this scan was weighed in
  double cluster_share = 0.0;  ///< of the weight, held by the cluster that gives the pose
  double fit = 0.0;  ///< mean likelihood of the beams, 1: all hit the map's surfaces exactly
  double random_share = 0.0;  ///< of the particles drawn anew for recovery
  std::size_t particles = 0;
};

/// Monte Carlo localisation with KLD-sampling and random-particle recovery. An update: move the
/// particles by the odometry since the last update, weigh them by the scan, take the heaviest
/// cluster for the pose, resample where the weights have become uneven or the number of particles
/// is wrong. While the robot stands and its pose is known nothing is weighed in: the same scan
/// again is no new evidence.
///
/// Recovery particles are not plainly uniform: uniform candidates are weighed by the scan at hand
/// and drawn in proportion, as in sensor resetting (Lenser and Veloso, ICRA 2000), since in a large
/// building a few hundred uniform ones all miss.
///
/// The beams of one scan share the map's errors and the robot's, so their likelihoods are not
/// multiplied as if they were independent: the product is tempered to `independent_beams` beams'
/// worth.
class Amcl {
 public:
  Amcl(const AmclConfig& config, const OccupancyGrid& map, std::uint64_t seed);

  /// Places the particles by a normal distribution.
  void set_pose(const PoseEstimate& robot_in_map);
  /// Spreads the particles over all free space. Returns false and changes nothing where the map has
  /// none.
  bool scatter();

  /// Has nothing to say before set_pose() or scatter(), and about a scan no newer than the last.
  [[nodiscard]] std::optional<Estimate> update(const LaserScan& scan, const Pose2& laser_in_base,
                                               const Pose2& base_in_odom);

  [[nodiscard]] const ParticleSet& particles() const { return particles_; }
  [[nodiscard]] bool localised() const { return estimate_.localised; }

 private:
  [[nodiscard]] std::optional<Pose2> motion_since_update(Time stamp, const Pose2& base_in_odom);
  void predict(const Pose2& motion);
  [[nodiscard]] bool weigh(const LaserScan& scan, const Pose2& laser_in_base);
  void temper(std::vector<float>& weights);
  void draw_fresh();
  void settle(const Cluster& cluster);
  void resample(const Cluster& cluster);

  AmclConfig config_;
  LikelihoodField field_;
  FreeSpace free_space_;
  ArcMotionModel motion_model_;
  Resampler resampler_;
  ClusterFinder clusters_;
  Recovery recovery_;
  RandomStream random_;

  ParticleSet particles_;
  ParticleSet resampled_;
  ParticleSet fresh_;  ///< candidates of recovery, weighed by the last scan
  BeamEnds ends_;
  std::vector<float> scores_;
  Estimate estimate_;
  std::optional<StampedPose2> last_odometry_;    ///< of the last scan
  std::optional<Pose2> base_in_odom_at_update_;  ///< of the last scan weighed in
  std::size_t updates_ = 0;
  int settling_ = 0;  ///< scans still to be weighed in even if the robot stands
};

}  // namespace coop::amcl
