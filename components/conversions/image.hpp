#pragma once
#include <sensor_msgs/msg/Image.h>

#include <opencv2/core/mat.hpp>
#include <string>

#include "core/result.hpp"
#include "core/time.hpp"

namespace coop::conversions {

inline constexpr int kMaxImageEdge = 16'384;  ///< pixels

/// Pixels and what they mean: rgb8, bgr8, mono8, 16UC1 (depth in mm, 0 unknown) or 32FC1 (depth in
/// m).
struct Picture {
  Time stamp{};
  std::string frame_id;
  std::string encoding;
  cv::Mat pixels;
};

/// Refused: an encoding other than the above, pixels of another type than the encoding says, an
/// empty picture.
[[nodiscard]] Result<sensor_msgs::msg::Image> to_msg(const Picture& picture);
/// A copy of the pixels, in the order of channels the message has them. Refused: an unknown
/// encoding, no pixels or more than kMaxImageEdge in a row or column, rows shorter than their
/// pixels, a number of bytes that is not step x height, and 16 or 32-bit pixels in big endian
/// order.
[[nodiscard]] Result<Picture> from_msg(const sensor_msgs::msg::Image& message);

}  // namespace coop::conversions
