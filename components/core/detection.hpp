#pragma once
#include <Eigen/Core>
#include <string>

namespace coop {

/// One object that a detector found, in the frame and at the stamp of its
/// Stamped<std::vector<Detection>>. An empty list says that the detector looked and saw none.
struct Detection {
  std::string class_id;                                  ///< e.g. "egg"
  double score = 0.0;                                    ///< 0 to 1, higher is surer
  Eigen::Vector3d position{0, 0, 0};                     ///< centre, m
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the position, m^2
  Eigen::Vector3d size{0, 0, 0};                         ///< edges of the box around it, m
  std::string id;  ///< the same object in time; empty: not tracked
};

}  // namespace coop
