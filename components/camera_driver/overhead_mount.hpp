#pragma once
#include <string_view>

#include "core/config/fields.hpp"
#include "core/intrinsics.hpp"
#include "core/pose.hpp"

namespace coop::camera_driver {

inline constexpr std::string_view kOverheadOpticalFrame = "overhead_camera_optical_frame";

/// A camera under the ceiling that looks straight down: where it hangs and what it sees. The
/// default shows a pen of 5 m x 3 m whole, its walls included.
struct OverheadMount {
  double x = 2.5;               ///< m in map
  double y = 1.5;               ///< m in map
  double height = 2.8;          ///< m above the floor
  double yaw = 0.0;             ///< rad in map, of the picture's columns
  int width = 640;              ///< px
  int rows = 400;               ///< px
  double field_of_view = 1.58;  ///< rad across the width

  void describe(config::Fields& fields);

  [[nodiscard]] Intrinsics intrinsics() const;
  /// The optical frame in map, whose floor is z = 0.
  [[nodiscard]] Pose3 camera_in_map() const;
};

}  // namespace coop::camera_driver
