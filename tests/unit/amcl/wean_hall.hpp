#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "core/pose.hpp"
#include "core/scan.hpp"
#include "support/shared_data.hpp"

/// The Wean Hall recordings of CMU: a map and two drives through an office building, lengths in
/// centimetres, format in the data set's instruct.txt. Files are gzipped; gzip reads them.
namespace coop::test::wean_hall {

inline std::optional<std::string> unpacked(const std::string& name) {
  const auto path = shared_data("localisation/" + name);
  if (!path) return std::nullopt;
  const std::string command = "gzip -dc '" + path->string() + "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  if (!pipe) return std::nullopt;
  std::string text;
  std::string buffer(1U << 16U, '\0');
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe.get())) {
    text.append(buffer, 0, count);
  }
  return text;
}

/// 800 x 800 cells of 10 cm. The numbers are probabilities of being free (instruct.txt says
/// occupied, but corridors are 1); a line holds one x. Middling values come from smoothing and
/// count as unknown.
inline std::optional<OccupancyGrid> map() {
  const auto text = unpacked("wean.dat.gz");
  if (!text) return std::nullopt;
  std::istringstream in(text->substr(text->find("global_map[")));
  std::string word;
  int width = 0;
  int height = 0;
  in >> word >> width >> height;
  OccupancyGrid grid({width, height, 0.1, {0, 0}}, kUnknown);
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height; ++y) {
      double is_free = 0.0;
      in >> is_free;
      if (is_free >= 0.9) grid[{x, y}] = kFree;
      if (is_free >= 0.0 && is_free <= 0.35) grid[{x, y}] = kOccupied;
    }
  }
  if (!in) return std::nullopt;
  return grid;
}

struct Record {
  LaserScan scan;
  Pose2 base_in_odom;
  Pose2 laser_in_base;
};

/// The log's laser lines: 180 beams over 180 degrees from right to left.
inline std::optional<std::vector<Record>> log(const std::string& name) {
  const auto text = unpacked(name);
  if (!text) return std::nullopt;
  std::vector<Record> records;
  std::istringstream in(*text);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] != 'L') continue;
    std::istringstream fields(line.substr(1));
    Record record;
    Pose2 laser_in_odom;
    const auto read_pose = [&](Pose2& pose) {
      fields >> pose.x >> pose.y >> pose.yaw;
      pose.x /= 100.0;
      pose.y /= 100.0;
    };
    read_pose(record.base_in_odom);
    read_pose(laser_in_odom);
    record.laser_in_base = record.base_in_odom.inverse() * laser_in_odom;
    LaserScan& scan = record.scan;
    scan.angle_increment = std::numbers::pi_v<float> / 180.0F;
    scan.angle_min = -89.5F * scan.angle_increment;
    scan.range_min = 0.1F;
    scan.range_max = 80.0F;
    for (int i = 0; i < 180; ++i) {
      float range = 0.0F;
      fields >> range;
      scan.ranges.push_back(range / 100.0F);
    }
    double stamp = 0.0;
    fields >> stamp;
    scan.stamp = time_from_seconds(1.0 + stamp);
    if (fields) records.push_back(std::move(record));
  }
  return records;
}

}  // namespace coop::test::wean_hall
