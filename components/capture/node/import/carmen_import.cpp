#include "capture/node/import/carmen_import.hpp"

#include <nav_msgs/msg/Odometry.h>
#include <sensor_msgs/msg/LaserScan.h>
#include <tf2_msgs/msg/TFMessage.h>

#include <array>
#include <stdexcept>

#include "capture/schema/definitions.hpp"
#include "capture/traffic/offered_qos.hpp"
#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "runtime/message_type.hpp"

namespace coop::capture {
namespace {

template <class Message>
class Channel {
 public:
  Channel(mcap::Writer& writer, const std::string& topic, const std::string& type,
          const OfferedQos& qos)
      : writer_(writer) {
    const auto schema = writer.add_schema(type, "ros2msg", *ros2msg_definition(type));
    message_.channel_id =
        writer.add_channel(schema, topic, "cdr", {{"offered_qos_profiles", to_yaml(qos)}});
  }

  void write(const Message& message, Time stamp) {
    if (stamp < Time{}) throw std::runtime_error("a record has a stamp before 1970");
    runtime::message_type<Message>().serialize(&message, bytes_);
    message_.log_time = static_cast<mcap::Nanoseconds>(to_nanoseconds(stamp));
    message_.publish_time = message_.log_time;
    message_.data = std::as_bytes(std::span(bytes_));
    writer_.write(message_);
    ++message_.sequence;
  }

 private:
  mcap::Writer& writer_;
  mcap::Message message_;
  std::vector<std::uint8_t> bytes_;
};

/// As a robot of ours offers them (runtime/qos.hpp): streams, events, and what is latched.
const OfferedQos kStream{.reliable = false};
const OfferedQos kEvents{};
const OfferedQos kLatched{.transient_local = true};

tf2_msgs::msg::TFMessage transform_message(Time stamp, const std::string& parent,
                                           const std::string& child, const Pose2& pose) {
  const std::array transforms{StampedTransform{stamp, parent, child, to_pose3(pose)}};
  return conversions::to_msg(std::span<const StampedTransform>(transforms));
}

std::optional<Odometry> odometry_of(const carmen::Record& record) {
  if (const auto* odometry = std::get_if<carmen::OdometryRecord>(&record)) {
    return carmen::to_odometry(*odometry);
  }
  if (const auto* laser = std::get_if<carmen::LaserRecord>(&record)) {
    return carmen::to_odometry(*laser);
  }
  return std::nullopt;
}

class Import {
 public:
  Import(const CarmenImportOptions& options, mcap::Writer& writer)
      : options_(options),
        scans_(writer, "/scan", "sensor_msgs/msg/LaserScan", kStream),
        odometry_(writer, "/odom", "nav_msgs/msg/Odometry", kStream),
        transforms_(writer, "/tf", "tf2_msgs/msg/TFMessage", kEvents),
        static_transforms_(writer, "/tf_static", "tf2_msgs/msg/TFMessage", kLatched) {}

  void mount(Time stamp) {
    static_transforms_.write(
        transform_message(stamp, options_.base_frame, options_.laser_frame, options_.laser_in_base),
        stamp);
  }
  void add(const carmen::LaserRecord& laser) {
    if (laser.rear) return;
    scans_.write(conversions::to_msg(carmen::to_scan(laser, options_.laser_frame)), laser.stamp);
    ++report_.scans;
  }
  void add(const Odometry& odometry) {
    conversions::FramedOdometry framed{.odometry = odometry,
                                       .frame_id = options_.odom_frame,
                                       .child_frame_id = options_.base_frame};
    odometry_.write(conversions::to_msg(framed), odometry.stamp);
    transforms_.write(transform_message(odometry.stamp, options_.odom_frame, options_.base_frame,
                                        odometry.base_in_odom),
                      odometry.stamp);
    ++report_.odometry;
  }
  [[nodiscard]] CarmenImportReport& report() { return report_; }

 private:
  const CarmenImportOptions& options_;
  Channel<sensor_msgs::msg::LaserScan> scans_;
  Channel<nav_msgs::msg::Odometry> odometry_;
  Channel<tf2_msgs::msg::TFMessage> transforms_;
  Channel<tf2_msgs::msg::TFMessage> static_transforms_;
  CarmenImportReport report_;
};

}  // namespace

CarmenImportReport import_carmen(std::vector<carmen::Record> records,
                                 const CarmenImportOptions& options, mcap::Writer& writer) {
  Import import(options, writer);
  import.report().mended_stamps = carmen::sort_by_stamp(records);
  bool mounted = false;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto odometry = odometry_of(records[i]);
    if (!odometry) continue;
    if (!mounted) import.mount(odometry->stamp);
    mounted = true;
    // Odometry first: who takes in the scan can then place it.
    const auto next = i + 1 < records.size() ? odometry_of(records[i + 1]) : std::nullopt;
    if (!next || next->stamp != odometry->stamp) import.add(*odometry);
    if (const auto* laser = std::get_if<carmen::LaserRecord>(&records[i])) import.add(*laser);
  }
  if (!mounted) throw std::runtime_error("the log holds neither scans nor odometry");
  return import.report();
}

}  // namespace coop::capture
