#include <array>
#include <cmath>
#include <cstdio>

#include "core/carmen/carmen_log.hpp"

namespace coop::carmen {
namespace {

void append(std::string& out, const char* format, double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), format, value);
  out += ' ';
  out += text.data();
}

void append(std::string& out, const Pose2& pose) {
  for (const double value : {pose.x, pose.y, pose.yaw}) append(out, "%.6f", value);
}

void append(std::string& out, const std::vector<float>& values) {
  out += ' ' + std::to_string(values.size());
  for (const float value : values) append(out, "%.4g", static_cast<double>(value));
}

void append_trailer(std::string& out, Time stamp) {
  const std::int64_t nanoseconds = to_nanoseconds(stamp);
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%lld.%09lld",
                static_cast<long long>(nanoseconds / 1'000'000'000),
                static_cast<long long>(nanoseconds % 1'000'000'000));
  out += ' ' + std::string(text.data()) + " nohost " + text.data() + '\n';
}

struct LineWriter {
  std::string operator()(const OdometryRecord& record) const {
    std::string out = "ODOM";
    append(out, record.robot_in_odom);
    for (const double value : {record.v, record.omega, record.acceleration})
      append(out, "%.6f", value);
    append_trailer(out, record.stamp);
    return out;
  }
  std::string operator()(const LaserRecord& record) const {
    std::string out = record.rear ? "ROBOTLASER2 0" : "ROBOTLASER1 0";
    const auto beams = static_cast<double>(record.ranges.size());
    for (const double value : {record.angle_min, beams * record.angle_increment,
                               record.angle_increment, record.range_max}) {
      append(out, "%.9f", value);
    }
    out += " 0.01 0";
    append(out, record.ranges);
    append(out, record.remissions);
    append(out, record.laser_in_odom);
    append(out, record.robot_in_odom);
    out += " 0 0 0 0 0";
    append_trailer(out, record.stamp);
    return out;
  }
  std::string operator()(const ParameterRecord& record) const {
    return "PARAM " + record.name + ' ' + record.value + " nohost 0\n";
  }
};

}  // namespace

std::string to_line(const Record& record) {
  return std::visit(LineWriter{}, record);
}

}  // namespace coop::carmen
