#pragma once
#include <vision_msgs/msg/Detection3DArray.h>

#include <vector>

#include "core/detection.hpp"
#include "core/result.hpp"
#include "core/stamped.hpp"

namespace coop::conversions {

inline constexpr std::size_t kMaxDetections = 10'000;

/// Each detection becomes one hypothesis at its position, and a box around it that is not rotated.
[[nodiscard]] vision_msgs::msg::Detection3DArray to_msg(
    const Stamped<std::vector<Detection>>& detections);
/// Of several hypotheses the one with the highest score (the first of equals) counts. Refused: a
/// detection without hypothesis, in a frame other than the list's (an empty name stands for the
/// list's), with a score outside 0 to 1, a negative size, numbers that are not finite, or a
/// covariance that is none; more than kMaxDetections.
[[nodiscard]] Result<Stamped<std::vector<Detection>>> from_msg(
    const vision_msgs::msg::Detection3DArray& message);

}  // namespace coop::conversions
