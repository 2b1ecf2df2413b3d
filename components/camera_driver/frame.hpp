#pragma once
#include <opencv2/core/mat.hpp>

#include "core/time.hpp"

namespace coop::camera_driver {

/// A colour picture and the depth along the optical axis of the same pixels.
struct Frame {
  Time stamp{};
  cv::Mat colour;  ///< CV_8UC3: red, green, blue
  cv::Mat depth;   ///< CV_16UC1: mm, 0 where unknown
};

}  // namespace coop::camera_driver
