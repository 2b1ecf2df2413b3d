#pragma once
#include "core/config/fields.hpp"

namespace coop::camera_driver {

/// Error of a stereo camera's depth: a constant part, and one that grows with the square of the
/// depth, as an error of disparity does.
struct DepthNoise {
  double constant = 0.002;    ///< m
  double quadratic = 0.0025;  ///< m per m^2 of depth

  [[nodiscard]] double stddev(double depth) const { return constant + quadratic * depth * depth; }

  void describe(config::Fields& fields) {
    fields.number("constant", constant,
                  {.unit = "m", .help = "deviation of a near depth", .min = 0, .max = 1});
    fields.number("quadratic", quadratic,
                  {.unit = "1/m", .help = "growth with the depth squared", .min = 0, .max = 1});
  }
};

}  // namespace coop::camera_driver
