#pragma once
#include <cstdint>
#include <vector>

#include "camera_driver/depth_noise.hpp"
#include "camera_driver/frame.hpp"
#include "core/config/fields.hpp"

namespace coop::camera_driver {

struct SensorNoiseConfig {
  DepthNoise depth;
  double smooth_share = 0.5;  ///< of the depth's variance that neighbouring pixels have in common
  double dropout = 0.005;     ///< share of pixels without depth
  double colour = 3.0;        ///< deviation of one channel, in 256ths of its range

  void describe(config::Fields& fields);
};

/// Makes a measurement of an exact picture. Deviates come from tables drawn once; the place in them
/// where each row begins is drawn for each frame. So a frame's noise is a function of seed and
/// stamp alone: a restarted driver, or one that missed a frame, measures the same.
class SensorNoise {
 public:
  SensorNoise(const SensorNoiseConfig& config, double range_min, double range_max,
              std::uint64_t seed);

  /// Adds noise to frame.colour, and writes frame.depth from the exact depth (m, 0: nothing).
  void apply(const std::vector<float>& exact_depth, Frame& frame) const;
  /// The same without depth.
  void apply_to_colour(Frame& frame) const;

 private:
  void add_to_colour(std::uint8_t* row, int columns, std::size_t start) const;

  SensorNoiseConfig config_;
  double range_min_;
  double range_max_;
  std::uint64_t seed_;
  std::vector<float> white_;         ///< deviates of mean 0 and deviation 1
  std::vector<float> smooth_;        ///< the same, alike within some pixels: a square that repeats
  std::vector<std::int8_t> colour_;  ///< deviates times the colour's deviation
  std::vector<std::uint8_t> lost_;   ///< 1: no depth
};

}  // namespace coop::camera_driver
