#include "core/carmen/carmen_log.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <system_error>

#include "core/carmen/fields.hpp"

namespace coop::carmen {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr Duration kLatestLine = std::chrono::seconds(10);

std::unique_ptr<std::istream> open(const std::filesystem::path& path) {
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file || std::filesystem::is_directory(path)) {
    const int code = errno != 0 ? errno : EISDIR;
    throw std::system_error(code, std::generic_category(), "cannot read " + path.string());
  }
  return file;
}

bool is_message_name(std::string_view word) {
  return !word.empty() && std::ranges::all_of(word, [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

/// Host name and the logger's own stamp end every line; neither is of use, but a line that lacks
/// them is cut.
void take_trailer(FieldCursor& fields) {
  fields.word("the host name");
  fields.word("the logger's stamp");
}

OdometryRecord parse_odometry(FieldCursor fields) {
  OdometryRecord record;
  record.robot_in_odom = fields.pose("pose of the robot");
  record.v = fields.number("tv");
  record.omega = fields.number("rv");
  record.acceleration = fields.number("accel");
  record.stamp = fields.stamp("the stamp");
  take_trailer(fields);
  return record;
}

ParameterRecord parse_parameter(FieldCursor fields) {
  ParameterRecord record;
  record.name = fields.word("the parameter's name");
  record.value = fields.word("the parameter's value");
  return record;
}

LaserRecord parse_new_laser(FieldCursor fields, bool rear) {
  LaserRecord record;
  record.rear = rear;
  fields.number("laser type");
  record.angle_min = fields.number("start angle");
  fields.number("field of view");
  record.angle_increment = fields.number("angular resolution");
  record.range_max = fields.number("maximum range");
  fields.number("accuracy");
  fields.number("remission mode");
  record.ranges = fields.values("readings");
  record.remissions = fields.values("remissions");
  record.laser_in_odom = fields.pose("pose of the laser");
  record.robot_in_odom = fields.pose("pose of the robot");
  for (const char* name :
       {"tv", "rv", "forward safety distance", "side safety distance", "turn axis"}) {
    fields.number(name);
  }
  record.stamp = fields.stamp("the stamp");
  take_trailer(fields);
  return record;
}

/// What the older messages leave unsaid; CARMEN's own convention by the number of readings.
double increment_of(std::size_t readings) {
  switch (readings) {
    case 180:
    case 181:
      return kDegree;
    case 360:
    case 361:
      return 0.5 * kDegree;
    case 401:
      return 0.25 * kDegree;
    default:
      return readings > 0 ? std::numbers::pi / static_cast<double>(readings) : 0.0;
  }
}

Time* mutable_stamp(Record& record) {
  if (auto* odometry = std::get_if<OdometryRecord>(&record)) return &odometry->stamp;
  if (auto* laser = std::get_if<LaserRecord>(&record)) return &laser->stamp;
  return nullptr;
}

double start_of(std::size_t readings) {
  return readings == 401 ? -50.0 * kDegree : -0.5 * std::numbers::pi;
}

}  // namespace

LogReader::LogReader(const std::filesystem::path& path) : in_(open(path)), name_(path.string()) {}

LogReader::LogReader(std::unique_ptr<std::istream> in, std::string name)
    : in_(std::move(in)), name_(std::move(name)) {}

std::optional<Record> LogReader::next() {
  while (std::getline(*in_, line_)) {
    ++report_.lines;
    const bool complete = !in_->eof();  // ended by a newline
    std::string_view line = line_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.front() == '#') continue;
    try {
      if (auto record = parse(line)) {
        note(*record);
        return record;
      }
      ++report_.other_messages;
    } catch (const FormatError& error) {
      if (complete)
        throw FormatError(name_ + ":" + std::to_string(report_.lines) + ": " + error.what());
      report_.truncated_line = report_.lines;
    }
  }
  return std::nullopt;
}

std::optional<Record> LogReader::parse(std::string_view line) const {
  FieldCursor fields(line);
  const std::string_view message = fields.word("the name of a message");
  if (message == "ODOM") return parse_odometry(fields);
  if (message == "FLASER" || message == "RLASER")
    return parse_old_laser(fields, message == "RLASER");
  if (message == "ROBOTLASER1" || message == "ROBOTLASER2") {
    return parse_new_laser(fields, message == "ROBOTLASER2");
  }
  if (message == "PARAM") return parse_parameter(fields);
  if (!is_message_name(message)) {
    throw FormatError("expected a CARMEN message (ODOM, FLASER, ROBOTLASER1, PARAM...)");
  }
  return std::nullopt;
}

LaserRecord LogReader::parse_old_laser(FieldCursor fields, bool rear) const {
  LaserRecord record;
  record.rear = rear;
  record.ranges = fields.values("readings");
  record.angle_min = start_of(record.ranges.size());
  record.angle_increment = increment_of(record.ranges.size());
  record.range_max = rear ? rear_range_max_ : front_range_max_;
  record.laser_in_odom = fields.pose("pose of the laser");
  record.robot_in_odom = fields.pose("odometry pose of the robot");
  record.stamp = fields.stamp("the stamp");
  take_trailer(fields);
  return record;
}

void LogReader::note(const Record& record) {
  ++report_.records;
  if (const auto* parameter = std::get_if<ParameterRecord>(&record)) {
    const bool front = parameter->name == "robot_front_laser_max";
    if (!front && parameter->name != "robot_rear_laser_max") return;
    const auto value = parse_number(parameter->value);
    if (!value || *value <= 0.0) {
      throw FormatError("expected a positive number of metres for " + parameter->name);
    }
    (front ? front_range_max_ : rear_range_max_) = *value;
    return;
  }
  const Time stamp = *stamp_of(record);
  if (stamp < latest_) ++report_.backward_stamps;
  latest_ = std::max(latest_, stamp);
}

std::optional<Time> stamp_of(const Record& record) {
  if (const auto* odometry = std::get_if<OdometryRecord>(&record)) return odometry->stamp;
  if (const auto* laser = std::get_if<LaserRecord>(&record)) return laser->stamp;
  return std::nullopt;
}

std::vector<Record> read_log(const std::filesystem::path& path, ReadReport* report) {
  LogReader reader(path);
  std::vector<Record> records;
  while (auto record = reader.next()) records.push_back(std::move(*record));
  if (report != nullptr) *report = reader.report();
  return records;
}

std::size_t sort_by_stamp(std::vector<Record>& records) {
  std::size_t repaired = 0;
  Time latest{};
  for (Record& record : records) {
    Time* stamp = mutable_stamp(record);
    if (stamp == nullptr) continue;
    if (*stamp < latest - kLatestLine) {
      *stamp = latest;
      ++repaired;
    }
    latest = std::max(latest, *stamp);
  }
  std::ranges::stable_sort(
      records, {}, [](const Record& record) { return stamp_of(record).value_or(Time::min()); });
  return repaired;
}

Odometry to_odometry(const OdometryRecord& record) {
  return {record.stamp, record.robot_in_odom, {record.v, record.omega}};
}

Odometry to_odometry(const LaserRecord& record) {
  return {record.stamp, record.robot_in_odom, {}};
}

LaserScan to_scan(const LaserRecord& record, std::string frame_id) {
  LaserScan scan;
  scan.stamp = record.stamp;
  scan.frame_id = std::move(frame_id);
  scan.angle_min = static_cast<float>(record.angle_min);
  scan.angle_increment = static_cast<float>(record.angle_increment);
  scan.range_max = static_cast<float>(record.range_max);
  scan.ranges = record.ranges;
  for (float& range : scan.ranges) {
    if (range >= scan.range_max) range = std::numeric_limits<float>::infinity();
    if (range <= 0.0F) range = std::numeric_limits<float>::quiet_NaN();
  }
  return scan;
}

}  // namespace coop::carmen
