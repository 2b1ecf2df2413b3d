#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/result.hpp"

namespace coop {

/// A PNG or JPEG picture (told apart by its first bytes) as red, green, blue of 8 bits; what is
/// transparent becomes black, a camera's note of how it was held is not followed. The error is one
/// line: no such file, no picture, or one of more than 64 million pixels.
[[nodiscard]] Result<cv::Mat> read_picture(const std::filesystem::path& path);

/// The bytes of a PNG file. `picture`: blue, green, red of 8 bits, as OpenCV draws; throws
/// std::invalid_argument for another kind.
[[nodiscard]] std::string encode_png(const cv::Mat& picture);

}  // namespace coop
