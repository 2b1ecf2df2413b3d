#pragma once
#include <Eigen/Core>

#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/random.hpp"
#include "slam/match_field.hpp"
#include "slam/scan_points.hpp"

namespace coop::slam {

struct ScanMatcherConfig {
  MatchFieldConfig field;
  double likelihood_gain = 3.0;  ///< weight of a beam's log-likelihood against odometry
  double weight_gain = 0.1;      ///< the same in a particle's weight: beams are not independent
  double linear_step = 0.08;     ///< m, first step of the search
  double angular_step = 0.04;    ///< rad
  int refinements = 6;           ///< times the steps are halved
  double poor_match = -0.6;      ///< mean log-likelihood a beam below which the wide search starts
  double wide_position = 0.6;    ///< m, the wide search's reach to each side
  double wide_yaw = 0.6;         ///< rad
  double search_margin = 0.5;    ///< m, of the field beyond the scan at the predicted pose
  double sample_spread = 1.5;    ///< deviations between samples around the maximum

  void describe(config::Fields& fields);
};

/// Where the scan says the robot is: a Gaussian over deviations (x, y, yaw) from the predicted
/// pose, in its frame.
struct Proposal {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double log_evidence =
      0.0;  ///< log of the integral of p(scan | pose) p(pose | odometry): the particle's weight
  double mean_likelihood = 0.0;  ///< log-likelihood a beam at the maximum
  bool matched = false;          ///< false: no walls in reach, the proposal is odometry's
};

/// Scan-matching improved proposal of Grisetti, Stachniss, Burgard: Improved Techniques for Grid
/// Mapping with Rao-Blackwellized Particle Filters (2007), algorithm 1. From the odometry's pose a
/// hill climb finds the maximum of p(scan | map, pose)^gain p(pose | odometry); K poses around it
/// give the Gaussian's moments and the weight (equations 15-19). Deviations: the likelihood is a
/// smooth field over distances to the map's walls instead of ray casting; the sample points are a
/// lattice scaled by the curvature at the maximum, not random draws, so a small K suffices and the
/// moments carry no sampling noise; the likelihood is tempered by a gain. Holds scratch space: one
/// per worker.
class ScanMatcher {
 public:
  explicit ScanMatcher(const ScanMatcherConfig& config) : config_(config), field_(config.field) {}

  [[nodiscard]] Proposal match(const TileMap& map, const ScanPoints& points,
                               const Pose2& predicted_base_in_map,
                               const Eigen::Vector3d& odometry_stddev);

 private:
  void prepare(const TileMap& map, const ScanPoints& points, const Pose2& predicted);
  [[nodiscard]] double objective(const Eigen::Vector3d& deviation) const;
  /// Of every `stride`-th point.
  [[nodiscard]] double likelihood(const Eigen::Vector3d& deviation, std::size_t stride = 1) const;
  [[nodiscard]] Eigen::Vector3d climb(const Eigen::Vector3d& start) const;
  [[nodiscard]] Eigen::Vector3d search_wide(const Eigen::Vector3d& mode) const;
  [[nodiscard]] Eigen::Matrix3d information_at(const Eigen::Vector3d& mode) const;
  void sample_around(const Eigen::Vector3d& mode, const Eigen::Matrix3d& information,
                     Proposal& proposal) const;

  ScanMatcherConfig config_;
  MatchField field_;
  std::vector<Eigen::Vector2f> points_;  ///< cells, in base_link
  Pose2 predicted_;                      ///< metres
  double inverse_resolution_ = 0.0;
  Eigen::Vector3d prior_information_ = Eigen::Vector3d::Zero();
};

}  // namespace coop::slam
