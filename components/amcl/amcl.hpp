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
#include "core/odometry_track.hpp"
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
  double localised_share = 0.85;  ///< and known only if that cluster holds this share of the weight
  double search_noise = 0.03;     ///< m and rad an update, spreads particles while the pose is open
  int settle_updates = 8;  ///< scans weighed in after the pose was found, even if the robot stands
  int standing_updates = 1;      ///< scans weighed in while the pose is open and the robot stands
  double standing_beams = 20.0;  ///< worth of all scans from one place, when the search goes on
  double searching_share =
      0.1;  ///< of the particles drawn anew at each update while the pose is open
  int scattered_particles = 100000;  ///< spread over free space for global localisation
  int recovery_candidates = 20000;   ///< poses tried against a scan to draw recovery particles from
  double lost_fit = 0.08;       ///< below, scans do not fit the map at the pose; see Estimate::fit
  double fit_rate = 0.1;        ///< decay a scan of the mean fit that is compared with it
  double restart_stddev = 0.2;  ///< m, moved unseen while odometry was restarted
  double restart_yaw_stddev = 0.2;  ///< rad, the same
  ArcMotionConfig motion;
  LikelihoodFieldConfig field;
  KldConfig kld;
  RecoveryConfig recovery;

  void describe(config::Fields& fields);
  void validate() const;
};

/// Why a pose is not known.
enum class Doubt {
  kNone,
  kSeveralPlaces,  ///< the particles are spread: scans fit more than one place, or were too few
  kMisfit,         ///< scans do not fit the map where the particles are
};

/// Where the robot is after a scan.
struct Estimate {
  Time stamp{};
  PoseEstimate robot_in_map;
  Pose2 odom_in_map;                    ///< takes odometry poses to the map
  bool localised = false;               ///< false: do not use the pose
  Doubt doubt = Doubt::kSeveralPlaces;  ///< kNone if localised
  bool updated = false;                 ///< this scan was weighed in
  double cluster_share = 0.0;           ///< of the weight, held by the cluster that gives the pose
  double fit = 0.0;  ///< mean likelihood of the beams, 1: all hit the map's surfaces exactly
  double random_share = 0.0;  ///< of the particles drawn anew for recovery
  std::size_t particles = 0;
};

/// Monte Carlo localisation with KLD-sampling and random-particle recovery. An update: move the
/// particles by the odometry since the last update, weigh them by the scan, take the heaviest
/// cluster for the pose, resample where the weights have become uneven or the number of particles
/// is wrong. While the robot stands and its pose is known nothing is weighed in: the same scan
/// again is no new evidence. It is watched only whether the scans still fit.
///
/// While the robot stands and its pose is open the search goes on, but not by multiplying in the
/// same evidence again and again, which would end in one place though two are alike. Instead the
/// particles, where nothing is known but these scans or they contradict what was believed, are
/// moved by Metropolis steps, which leave the distribution that the scans of this one place give as
/// it is, and a part is drawn anew from it by annealing candidates from all over the map. When they
/// represent it they lie in one place, or the pose stays open.
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
                                               const OdometryFix& odometry);

  [[nodiscard]] const ParticleSet& particles() const { return particles_; }
  [[nodiscard]] bool localised() const { return estimate_.localised; }

 private:
  void begin_search();
  [[nodiscard]] std::optional<Pose2> motion_since_update(Time stamp, const OdometryFix& odometry);
  void predict(const Pose2& motion);
  void spread(double position, double yaw);
  [[nodiscard]] bool choose_beams(const LaserScan& scan, const Pose2& laser_in_base);
  void weigh_in(const LaserScan& scan, const Pose2& laser_in_base, const Pose2& motion);
  void weigh();
  void jiggle(ParticleSet& set, double noise, double beams);
  void draw_annealed(double beams);
  void search_standing();
  void watch_fit();
  [[nodiscard]] double mean_fit() const;
  [[nodiscard]] double tracking_beams() const;
  void temper(std::vector<float>& weights, double beams);
  void draw_fresh(double beams);
  void settle(const Cluster& cluster, bool confirmed = true);
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
  ParticleSet fresh_;     ///< candidates of recovery, weighed by the last scan
  ParticleSet annealed_;  ///< the same of a standing search
  ParticleSet proposed_;  ///< scratch
  BeamEnds ends_;
  std::vector<float> scores_;
  std::vector<float> proposed_scores_;
  Estimate estimate_;
  std::optional<Time> last_stamp_;               ///< of the last scan
  std::uint32_t piece_ = 0;                      ///< of odometry, then
  std::optional<Pose2> base_in_odom_at_update_;  ///< of the last scan weighed in
  double mean_fit_ = 0.0;  ///< over the last scans, after each was weighed in; 0: none yet
  std::size_t updates_ = 0;
  bool knows_one_place_ = true;  ///< no scans from elsewhere speak for where the particles are
  int confirmed_ = 0;            ///< scans on end in which a standing search found the same place
  int settling_ = 0;             ///< scans still to be weighed in even if the robot stands
};

}  // namespace coop::amcl
