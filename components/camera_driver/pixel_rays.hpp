#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "camera_driver/intrinsics.hpp"
#include "core/pose.hpp"

namespace coop::camera_driver {

/// The ray of one pixel in base_link; its point at depth z (along the optical axis, m) is
/// camera + z * direction. Of interest is the stretch between the height of obstacles and the
/// floor.
struct PixelRay {
  Eigen::Vector3f direction;
  float level_length = 0.0F;  ///< m over the floor for each m of depth
  float enter = 0.0F;         ///< depth at which the ray comes below the obstacles' height
  float leave = 0.0F;         ///< depth at the floor, at that height again, or the farthest
  bool meets_floor = false;   ///< within the farthest depth
};

/// Pixels [column, column_end) x [row, row_end).
struct PixelBlock {
  int column = 0;
  int row = 0;
  int column_end = 0;
  int row_end = 0;
};

/// All rays of a camera that is fixed to the robot: computed once, as the floor does not move in
/// base_link.
class PixelRays {
 public:
  PixelRays(const Intrinsics& intrinsics, const Pose3& camera_in_base, double obstacle_height,
            double max_depth);

  [[nodiscard]] const Intrinsics& intrinsics() const { return intrinsics_; }
  /// Where all rays start, in base_link.
  [[nodiscard]] Eigen::Vector3d camera() const { return camera_in_base_.translation(); }
  [[nodiscard]] const PixelRay& at(int column, int row) const { return rays_[index(column, row)]; }
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(intrinsics_.width) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] std::size_t size() const { return rays_.size(); }
  /// All pixels in which something within a box (in base_link) can be seen.
  [[nodiscard]] PixelBlock cover(const Eigen::AlignedBox3d& box_in_base) const;

 private:
  Intrinsics intrinsics_;
  Pose3 camera_in_base_;
  std::vector<PixelRay> rays_;
};

}  // namespace coop::camera_driver
