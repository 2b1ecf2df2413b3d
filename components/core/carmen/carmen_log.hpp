#pragma once
#include <cstddef>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/odometry.hpp"
#include "core/pose.hpp"
#include "core/scan.hpp"
#include "core/time.hpp"

namespace coop::carmen {

/// `ODOM x y theta tv rv accel stamp host logger_stamp`
struct OdometryRecord {
  Time stamp{};  ///< first stamp of the line: when it was measured
  Pose2 robot_in_odom;
  double v = 0.0;             ///< m/s
  double omega = 0.0;         ///< rad/s
  double acceleration = 0.0;  ///< m/s2
  bool operator==(const OdometryRecord&) const = default;
};

/// `FLASER n r1..rn x y theta odom_x odom_y odom_theta stamp host logger_stamp`, RLASER alike, and
/// the newer `ROBOTLASER1 type start_angle fov increment max_range accuracy remission_mode n r1..rn
/// m i1..im laser_x laser_y laser_theta x y theta tv rv forward_safety side_safety turn_axis stamp
/// host logger_stamp`.
struct LaserRecord {
  Time stamp{};
  bool rear = false;              ///< RLASER or ROBOTLASER2
  double angle_min = 0.0;         ///< rad from the laser's x axis, first beam
  double angle_increment = 0.0;   ///< rad
  double range_max = 0.0;         ///< m; readings at or above it are misses
  std::vector<float> ranges;      ///< m, counter-clockwise
  std::vector<float> remissions;  ///< empty in the older form
  Pose2 laser_in_odom;            ///< in `*-corrected` logs: the corrected pose
  Pose2 robot_in_odom;            ///< raw odometry at this scan
  bool operator==(const LaserRecord&) const = default;
};

/// `PARAM name value`
struct ParameterRecord {
  std::string name;
  std::string value;
  bool operator==(const ParameterRecord&) const = default;
};

using Record = std::variant<OdometryRecord, LaserRecord, ParameterRecord>;

/// A line that names a known message and does not hold one. The message is one line: `file:line:
/// what was expected`.
class FormatError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class FieldCursor;

/// What was met in reading beside the records.
struct ReadReport {
  std::size_t lines = 0;
  std::size_t records = 0;
  std::size_t other_messages =
      0;  ///< lines of messages this reader has no use for (NEFF, SYNC, TRUEPOS...)
  std::size_t backward_stamps = 0;  ///< records stamped earlier than one before them in the file
  std::size_t truncated_line =
      0;  ///< number of the last line, left unread because the file ends within it; or 0
};

/// Reads a CARMEN log as a stream, one record at a time, in the file's order. Comments (#) and
/// empty lines are skipped. Stamps are parsed as decimals, exact to the nanosecond, and delivered
/// as they stand: loggers write lines late, so a stamp may run backwards; it is counted in the
/// report, and sort_by_stamp() gives the order in time. The older laser messages carry no geometry:
/// 180 or 181 readings cover pi in steps of one degree, 360 or 361 pi in half degrees, 401 in
/// quarter degrees over 100 degrees, other counts pi divided by the count; start is minus half the
/// field. Their range_max is 80 m unless a `PARAM robot_front_laser_max` (rear alike) came before.
class LogReader {
 public:
  /// Throws std::system_error where the file cannot be opened.
  explicit LogReader(const std::filesystem::path& path);
  /// `name` stands for the file in messages.
  LogReader(std::unique_ptr<std::istream> in, std::string name);

  /// The next record, or nothing at the end. Throws FormatError.
  [[nodiscard]] std::optional<Record> next();

  [[nodiscard]] const ReadReport& report() const { return report_; }

 private:
  [[nodiscard]] std::optional<Record> parse(std::string_view line) const;
  [[nodiscard]] LaserRecord parse_old_laser(FieldCursor fields, bool rear) const;
  void note(const Record& record);

  std::unique_ptr<std::istream> in_;
  std::string name_;
  std::string line_;
  ReadReport report_;
  Time latest_{};
  double front_range_max_ = 80.0;  ///< m
  double rear_range_max_ = 80.0;   ///< m
};

/// Stamp of an odometry or laser record; nothing for a parameter.
[[nodiscard]] std::optional<Time> stamp_of(const Record& record);

/// The whole log in the file's order. Throws as LogReader does.
[[nodiscard]] std::vector<Record> read_log(const std::filesystem::path& path,
                                           ReadReport* report = nullptr);

/// Orders records by stamp, for playback and algorithms on one time line; equal stamps keep the
/// file's order, parameters come first. A stamp more than 10 s before one ahead of it in the file
/// is no late line but a wrong one (real logs hold 2.48584e-91): it is set to that one first, so
/// the record keeps its place. Returns how many were.
std::size_t sort_by_stamp(std::vector<Record>& records);

/// One line of the log, ended by a newline, for the reader; lasers in the newer form, which carries
/// its geometry. Poses are rounded to a micrometre, readings to four digits.
[[nodiscard]] std::string to_line(const Record& record);

[[nodiscard]] Odometry to_odometry(const OdometryRecord& record);
/// Odometry that the laser record carries (velocity unknown, zero): a log's laser lines are
/// odometry readings too.
[[nodiscard]] Odometry to_odometry(const LaserRecord& record);
/// Scan in the laser's frame; readings at or above range_max become +inf (met nothing), those of
/// zero or less NaN (no measurement).
[[nodiscard]] LaserScan to_scan(const LaserRecord& record, std::string frame_id);

}  // namespace coop::carmen
