#include "amcl/cluster.hpp"

#include <algorithm>
#include <cmath>

namespace coop::amcl {

double position_stddev(const PoseEstimate& pose) {
  const Eigen::Matrix3d& covariance = pose.covariance;
  const double half_trace = (covariance(0, 0) + covariance(1, 1)) / 2.0;
  const double half_difference = (covariance(0, 0) - covariance(1, 1)) / 2.0;
  return std::sqrt(half_trace + std::hypot(half_difference, covariance(0, 1)));
}

Cluster ClusterFinder::heaviest(const ParticleSet& particles) {
  histogram_.clear();
  bin_of_particle_.resize(particles.size());
  double total = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double weight = static_cast<double>(particles.weight[i]);
    const Pose2 pose = particles.pose(i);
    bin_of_particle_[i] = histogram_.add(pose.x, pose.y, pose.yaw, weight);
    total += weight;
  }
  Cluster result;
  const double least = 0.1 * total / static_cast<double>(particles.size());
  result.clusters = histogram_.label_components(labels_);
  weights_.assign(result.clusters, 0.0);
  for (std::uint32_t bin = 0; bin < labels_.size(); ++bin) {
    weights_[labels_[bin]] += histogram_.weight(bin);
    result.bins += histogram_.weight(bin) > least ? 1 : 0;
  }
  const auto heaviest = static_cast<std::uint32_t>(
      std::max_element(weights_.begin(), weights_.end()) - weights_.begin());

  // Sums relative to one member keep the covariance free of cancellation.
  Pose2 reference;
  bool has_reference = false;
  double sum = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (labels_[bin_of_particle_[i]] != heaviest) continue;
    const Pose2 pose = particles.pose(i);
    if (!has_reference) {
      reference = pose;
      has_reference = true;
    }
    const double weight = static_cast<double>(particles.weight[i]);
    const Eigen::Vector3d offset{pose.x - reference.x, pose.y - reference.y,
                                 angle_difference(pose.yaw, reference.yaw)};
    sum += weight;
    first += weight * offset;
    second += weight * offset * offset.transpose();
  }
  if (sum <= 0.0) sum = 1.0;
  first /= sum;
  result.share = total > 0.0 ? sum / total : 0.0;
  result.pose.pose = {reference.x + first.x(), reference.y + first.y(),
                      normalize_angle(reference.yaw + first.z())};
  result.pose.covariance = second / sum - first * first.transpose();
  return result;
}

}  // namespace coop::amcl
