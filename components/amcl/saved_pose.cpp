#include "amcl/saved_pose.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/hash.hpp"

namespace coop::amcl {
namespace {

constexpr std::string_view kFormat = "coop amcl pose 1";
constexpr double kLongestGap = 30.0;  // s for which the odometry is believed to have run on
constexpr double kFastest = 1.5;      // m/s and rad/s

nlohmann::json to_json(const Pose2& pose) {
  return {pose.x, pose.y, pose.yaw};
}

Pose2 pose_from(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

}  // namespace

std::uint64_t hash_of(const OccupancyGrid& map) {
  Fnv1a hash;
  hash.add_word(static_cast<std::uint64_t>(map.geometry.width));
  hash.add_word(static_cast<std::uint64_t>(map.geometry.height));
  for (const double value :
       {map.geometry.resolution, map.geometry.origin.x(), map.geometry.origin.y()}) {
    hash.add_word(static_cast<std::uint64_t>(std::llround(value * 1e6)));
  }
  for (const std::int8_t cell : map.cells) hash.add(static_cast<std::uint8_t>(cell));
  return hash.value();
}

std::string to_text(const SavedPose& saved) {
  nlohmann::json json;
  json["format"] = kFormat;
  json["stamp"] = to_nanoseconds(saved.stamp);
  json["map"] = saved.map_hash;
  json["robot_in_map"] = to_json(saved.robot_in_map.pose);
  json["base_in_odom"] = to_json(saved.base_in_odom);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column <= row; ++column) {
      json["covariance"].push_back(saved.robot_in_map.covariance(row, column));
    }
  }
  return json.dump() + "\n";
}

Result<SavedPose> parse_saved_pose(std::string_view text) {
  SavedPose saved;
  try {
    const auto json = nlohmann::json::parse(text);
    if (json.at("format") != kFormat) return fail("is of another format");
    saved.stamp = Time(Duration(json.at("stamp").get<std::int64_t>()));
    saved.map_hash = json.at("map").get<std::uint64_t>();
    saved.robot_in_map.pose = pose_from(json.at("robot_in_map"));
    saved.base_in_odom = pose_from(json.at("base_in_odom"));
    std::size_t next = 0;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column <= row; ++column) {
        const double value = json.at("covariance").at(next++).get<double>();
        saved.robot_in_map.covariance(row, column) = value;
        saved.robot_in_map.covariance(column, row) = value;
      }
    }
  } catch (const nlohmann::json::exception& error) {
    return fail(std::string("is no saved pose: ") + error.what());
  }
  const Eigen::Vector3d variances = saved.robot_in_map.covariance.diagonal();
  if (!is_finite(saved.robot_in_map.pose) || !is_finite(saved.base_in_odom) ||
      !saved.robot_in_map.covariance.allFinite() || variances.minCoeff() < 0.0) {
    return fail("holds impossible numbers");
  }
  return saved;
}

PoseEstimate resume(const SavedPose& saved, Time now, const Pose2& base_in_odom) {
  PoseEstimate result = saved.robot_in_map;
  double way = 0.0;
  double turn = 0.0;
  const double elapsed = to_seconds(now - saved.stamp);
  if (elapsed >= 0.0 && elapsed <= kLongestGap) {
    const Pose2 motion = saved.base_in_odom.inverse() * base_in_odom;
    way = std::hypot(motion.x, motion.y);
    turn = std::abs(motion.yaw);
    const double limit = kFastest * (elapsed + 0.5);
    if (way <= limit && turn <= limit) {
      result.pose = result.pose * motion;
    } else {
      way = turn = 0.0;
    }
  }
  const double sideways = 0.05 + 0.1 * way;
  const double turned = 0.05 + 0.1 * turn;
  result.covariance(0, 0) += sideways * sideways;
  result.covariance(1, 1) += sideways * sideways;
  result.covariance(2, 2) += turned * turned;
  return result;
}

}  // namespace coop::amcl
