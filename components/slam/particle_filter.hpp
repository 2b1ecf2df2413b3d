#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "core/config/fields.hpp"
#include "core/grid.hpp"
#include "core/odometry_track.hpp"
#include "core/random.hpp"
#include "core/scan.hpp"
#include "slam/fork_join.hpp"
#include "slam/map_updater.hpp"
#include "slam/motion_noise.hpp"
#include "slam/scan_matcher.hpp"
#include "slam/scan_points.hpp"
#include "slam/tile_map.hpp"
#include "slam/trajectory.hpp"

namespace coop::slam {

struct SlamConfig {
  int particles = 30;
  double resolution = 0.05;      ///< m a cell
  double min_translation = 0.2;  ///< m since the last scan used
  double min_rotation = 0.15;    ///< rad
  double max_interval = 10.0;  ///< s, a scan is used after this time even without motion; 0: never
  double resample_threshold = 0.5;  ///< of the particles; resampled when fewer count effectively
  /// Mean log-likelihood a beam from which a scan is found again in the map after a restart; -2.3
  /// would be no beam at a wall, a third of the beams elsewhere give -0.8.
  double found_again = -0.8;
  double occupied_threshold =
      0.25;  ///< share of hits from which a cell of the published map is occupied
  ScanPointsConfig scan;
  MotionNoiseConfig motion;
  ScanMatcherConfig matcher;

  void describe(config::Fields& fields);
};

/// What became of one scan.
struct ScanOutcome {
  bool used = false;  ///< false: too little motion since the last one
  bool lost = false;  ///< not used: after a restart of odometry it fits nowhere near the last pose
  bool resampled = false;
  double effective_particles = 0.0;
  double mean_likelihood = 0.0;  ///< log-likelihood a beam, best particle
};

/// Rao-Blackwellised particle filter that maps with grids (Grisetti, Stachniss, Burgard 2007):
/// every particle is a trajectory with its map.
class ParticleFilter {
 public:
  ParticleFilter(const SlamConfig& config, std::uint64_t seed, ForkJoin& workers);

  /// The next scan, with odometry's pose of base_link at its stamp; `laser_in_base` is the mount.
  /// Scans come in the order of their stamps. The first defines the map: its base_link pose is the
  /// map's origin. Where odometry was restarted since the last scan used, the robot is sought
  /// around the pose that follows from what odometry knows, wider with every scan that does not
  /// find it, and nothing is drawn until it is found.
  ScanOutcome update(const LaserScan& scan, const OdometryFix& odometry, const Pose2& laser_in_base,
                     const Pose2& sweep = {});

  /// Goes on with a map that another filter made and the way it took, newest last and not empty.
  /// The robot is lost until a scan finds it near the end of that way.
  void resume(const TileMap& map, const std::vector<TrajectoryNode>& nodes);
  /// Where the robot is in the map is not known since odometry was restarted, or resume().
  [[nodiscard]] bool lost() const { return lost_; }

  [[nodiscard]] bool has_map() const { return !steps_.empty(); }
  /// Particle with the largest weight over its whole way.
  [[nodiscard]] std::size_t best() const;
  /// Of the best particle. Before the first scan: identity.
  [[nodiscard]] Pose2 odom_in_map() const;
  [[nodiscard]] OccupancyGrid map() const;
  /// Of the best particle; a copy of it shares the tiles, also with another thread.
  [[nodiscard]] const TileMap& tiles() const { return particles_[best()].map; }
  /// Of the best particle, a node for each scan used.
  [[nodiscard]] std::vector<TrajectoryNode> trajectory() const;
  [[nodiscard]] const std::vector<double>& weights() const { return weights_; }

 private:
  struct Particle {
    Pose2 base_in_map;
    TileMap map;
    double log_weight = 0.0;  ///< since the last resampling
    double total_log_weight = 0.0;
    double mean_likelihood = 0.0;
    bool matched = false;
  };
  /// One scan used: pose of every particle then, and which particle of the step before it descends
  /// from.
  struct Step {
    Time stamp{};
    Pose2 base_in_odom;
    std::vector<Pose2> poses;
    std::vector<std::uint32_t> parents;
  };
  struct Scratch {
    ScanMatcher matcher;
    MapUpdater updater;
  };

  [[nodiscard]] bool moved_enough(const LaserScan& scan, const Pose2& motion) const;
  /// Moves all; answers false and moves none where odometry was restarted and the scan fits
  /// nowhere.
  bool move_all(const ScanPoints& points, const Pose2& motion, bool restarted);
  void move(Particle& particle, RandomStream& random, Scratch& scratch, const ScanPoints& points,
            const Pose2& motion, const Eigen::Vector3d& stddev) const;
  [[nodiscard]] Pose2 search_offset(RandomStream& random) const;
  [[nodiscard]] bool is_found() const;
  bool resample_if_needed();

  SlamConfig config_;
  ForkJoin& workers_;
  std::vector<Particle> particles_;
  std::vector<RandomStream>
      streams_;  ///< one a particle slot, so that threads cannot shift each other's numbers
  RandomStream resampling_stream_;
  std::vector<Scratch> scratch_;  ///< one a worker
  std::vector<double> weights_;
  std::vector<std::uint32_t> parents_;
  std::vector<Step> steps_;
  std::optional<std::uint32_t> piece_;  ///< of odometry, at the last scan used; nothing: unknown
  bool lost_ = false;
  int failures_ = 0;  ///< scans on end that did not find the robot
};

}  // namespace coop::slam
