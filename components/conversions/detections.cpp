#include "conversions/detections.hpp"

#include <algorithm>

#include "conversions/covariance.hpp"
#include "conversions/geometry.hpp"
#include "conversions/time.hpp"

namespace coop::conversions {
namespace {

Result<Detection> detection_from(const vision_msgs::msg::Detection3D& message) {
  if (message.results().empty()) return fail("a detection without hypothesis");
  const auto score = [](const vision_msgs::msg::ObjectHypothesisWithPose& result) {
    return result.hypothesis().score();
  };
  for (const auto& result : message.results()) {
    if (!(score(result) >= 0.0 && score(result) <= 1.0)) return fail("a score outside 0 to 1");
  }
  const auto& best = *std::ranges::max_element(message.results(), {}, score);
  const auto position = from_msg(best.pose().pose().position());
  if (!position) return fail(position.error());
  const auto covariance = from_position_covariance(best.pose().covariance());
  if (!covariance) return fail(covariance.error());
  const auto size = from_msg(message.bbox().size());
  if (!size) return fail(size.error());
  if (size->minCoeff() < 0.0) return fail("a box of negative size");
  return Detection{
      best.hypothesis().class_id(), score(best), *position, *covariance, *size, message.id()};
}

}  // namespace

vision_msgs::msg::Detection3DArray to_msg(const Stamped<std::vector<Detection>>& detections) {
  vision_msgs::msg::Detection3DArray message;
  message.header(to_header(detections.stamp, detections.frame_id));
  message.detections().reserve(detections.value.size());
  for (const Detection& detection : detections.value) {
    auto& item = message.detections().emplace_back();
    item.header(message.header());
    item.id(detection.id);
    item.bbox().center().position(to_point_msg(detection.position));
    item.bbox().size(to_vector_msg(detection.size));
    auto& result = item.results().emplace_back();
    result.hypothesis().class_id(detection.class_id);
    result.hypothesis().score(detection.score);
    result.pose().pose().position(to_point_msg(detection.position));
    result.pose().covariance(to_position_covariance(detection.covariance));
  }
  return message;
}

Result<Stamped<std::vector<Detection>>> from_msg(
    const vision_msgs::msg::Detection3DArray& message) {
  const auto stamp = from_msg(message.header().stamp());
  if (!stamp) return fail(stamp.error());
  if (message.detections().size() > kMaxDetections) return fail("absurdly many detections");
  Stamped<std::vector<Detection>> list{*stamp, message.header().frame_id(), {}};
  list.value.reserve(message.detections().size());
  for (const auto& item : message.detections()) {
    const std::string& frame = item.header().frame_id();
    if (!frame.empty() && frame != list.frame_id) {
      return fail("a list in " + list.frame_id + " with a detection in " + frame);
    }
    auto detection = detection_from(item);
    if (!detection) return fail(std::move(detection.error()));
    list.value.push_back(std::move(*detection));
  }
  return list;
}

}  // namespace coop::conversions
