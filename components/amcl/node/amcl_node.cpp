#include "amcl/node/amcl_node.hpp"

#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "coop_msgs/msg/GlobalLocalization.h"
#include "core/atomic_file.hpp"
#include "core/config/error.hpp"
#include "core/map/map_file.hpp"

namespace coop::amcl {

using geometry_msgs::msg::PoseWithCovarianceStamped;
using runtime::Qos;

namespace {

constexpr auto kPatience = std::chrono::seconds(1);
constexpr std::size_t kMostScansWaiting = 20;
constexpr std::size_t kMostReadings = 2000;  // 40 s at 50 Hz, and thinned what was before
constexpr auto kScanAge = std::chrono::seconds(1);

OccupancyGrid load(const AmclNodeConfig& config) {
  if (config.map_file.empty()) throw config::Error("map_file: expected the YAML file of a map");
  return map::load_map(config.map_file);
}

}  // namespace

void InitialPoseConfig::describe(config::Fields& fields) {
  fields.flag("known", known, {.help = "false: global localisation from the start"});
  fields.number("x", x, {.unit = "m", .help = "in map"});
  fields.number("y", y, {.unit = "m", .help = "in map"});
  fields.number("yaw", yaw, {.unit = "rad", .help = "in map", .min = -7, .max = 7});
  fields.number("position_stddev", position_stddev,
                {.unit = "m", .help = "deviation of x and y", .min = 0.001, .max = 100});
  fields.number("yaw_stddev", yaw_stddev,
                {.unit = "rad", .help = "deviation of yaw", .min = 0.001, .max = 10});
}

PoseEstimate InitialPoseConfig::estimate() const {
  PoseEstimate estimate;
  estimate.pose = {x, y, yaw};
  estimate.covariance.diagonal() << position_stddev * position_stddev,
      position_stddev * position_stddev, yaw_stddev * yaw_stddev;
  return estimate;
}

void AmclNodeConfig::describe(config::Fields& fields) {
  fields.text("map_file", map_file, {.help = "YAML of the map to localise on and to serve"});
  fields.section("initial_pose", initial_pose);
  fields.number("transform_period", transform_period,
                {.unit = "s", .help = "between two transforms", .min = 0.01, .max = 1});
  fields.number("transform_ahead", transform_ahead,
                {.unit = "s", .help = "the transform is stamped ahead", .min = 0, .max = 2});
  fields.number("cloud_period", cloud_period,
                {.unit = "s", .help = "between two particle clouds", .min = 0.1, .max = 60});
  fields.number("save_period", save_period,
                {.unit = "s", .help = "between two poses saved", .min = 0.1, .max = 600});
  fields.integer("cloud_size", cloud_size,
                 {.help = "particles of a cloud, at most", .min = 1, .max = 100000});
  fields.section("odometry_restart", odometry_restart);
  amcl.describe(fields);
}

void AmclNode::check(const Config& config) {
  (void)load(config);
}

AmclNode::AmclNode(runtime::Node& node, const Config& config)
    : AmclNode(node, config, load(config)) {}

AmclNode::AmclNode(runtime::Node& node, const Config& config, const OccupancyGrid& map)
    : node_(node),
      config_(config),
      filter_(config.amcl, map, node.options().seed),
      map_hash_(hash_of(map)),
      transforms_(node.transforms()),
      odometry_(kMostReadings, config.odometry_restart),
      scans_({.patience = kPatience, .limit = kMostScansWaiting, .whole_sweep = false}),
      map_publisher_(node.advertise<nav_msgs::msg::OccupancyGrid>("map", Qos::kStateLatched)),
      pose_publisher_(node.advertise<PoseWithCovarianceStamped>("amcl_pose", Qos::kStateLatched)),
      cloud_publisher_(
          node.advertise<geometry_msgs::msg::PoseArray>("particle_cloud", Qos::kSensorStream)) {
  node.advertise_transforms();
  map_publisher_.publish(conversions::to_msg(Stamped<OccupancyGrid>{node.now(), "map", map}));
  subscribe();
  node.every(seconds(config.transform_period), [this] {
    process_scans();
    publish_transform();
  });
  node.every(seconds(config.cloud_period), [this] { publish_cloud(); });
  node.on_clock_jump([this] { handle_clock_jump(); });
}

void AmclNode::subscribe() {
  node_.subscribe<nav_msgs::msg::Odometry>(
      "odom", Qos::kSensorStream,
      [this](const nav_msgs::msg::Odometry& message, const runtime::MessageInfo& info) {
        const auto odometry = conversions::from_msg(message);
        if (!odometry) return;
        const auto& [stamp, base_in_odom, velocity] = odometry->odometry;
        if (odometry_.insert({stamp, base_in_odom}, info.writer))
          node_.log().warning("odometry was restarted: goes on from the last pose");
      },
      runtime::Attention::kPatient);
  node_.subscribe<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream,
                                               [this](const sensor_msgs::msg::LaserScan& message) {
                                                 auto scan = conversions::from_msg(message);
                                                 if (!scan) return;
                                                 scans_.push(std::move(*scan));
                                                 process_scans();
                                               });
  node_.subscribe<PoseWithCovarianceStamped>(
      "initialpose", Qos::kEvent, [this](const PoseWithCovarianceStamped& message) {
        const auto pose = conversions::from_msg(message);
        if (!pose || pose->frame_id != "map") {
          node_.log().warning("initialpose refused: {}", pose ? "not in map" : pose.error());
          return;
        }
        begun_ = true;
        filter_.set_pose(pose->value);
        node_.log().info("initial pose ({:.2f}, {:.2f}, {:.2f})", pose->value.pose.x,
                         pose->value.pose.y, pose->value.pose.yaw);
      });
  node_.subscribe<coop_msgs::msg::GlobalLocalization>(
      "global_localization", Qos::kEvent, [this](const coop_msgs::msg::GlobalLocalization&) {
        begun_ = true;
        node_.log().info("global localisation: {}",
                         filter_.scatter() ? "particles scattered" : "the map has no free space");
      });
}

std::filesystem::path AmclNode::saved_path() const {
  return node_.options().run_dir / (node_.name() + ".pose");
}

/// The first pose: from disk where it belongs to this map, else as configured.
void AmclNode::begin(Time now, const Pose2& base_in_odom) {
  begun_ = true;
  std::error_code error;
  if (std::filesystem::exists(saved_path(), error)) {
    const auto saved = parse_saved_pose(read_file(saved_path()));
    if (saved && saved->map_hash == map_hash_) {
      filter_.set_pose(resume(*saved, now, base_in_odom));
      node_.log().info("goes on from the pose on disk");
      return;
    }
    node_.log().warning("pose on disk not used: {}", saved ? "of another map" : saved.error());
  }
  if (config_.initial_pose.known) {
    filter_.set_pose(config_.initial_pose.estimate());
  } else if (!filter_.scatter()) {
    node_.log().error("no global localisation: the map has no free space");
  }
}

void AmclNode::process_scans() {
  while (const auto located = scans_.next(odometry_, transforms_, node_.now())) {
    const Time stamp = located->scan.stamp;
    const Pose2 base_in_odom =
        odometry_.odom_in_track().inverse() * located->base_in_track.base_in_odom;
    last_scan_ = stamp;
    if (!begun_) begin(stamp, base_in_odom);
    const auto estimate =
        filter_.update(located->scan, located->laser_in_base, located->base_in_track);
    if (estimate) take(*estimate, base_in_odom);
  }
  report_health();
}

void AmclNode::report_health() {
  if (last_scan_ == Time{} || node_.now() - last_scan_ > kScanAge) {
    node_.set_degraded("no scan with its odometry");
  } else if (filter_.localised()) {
    node_.set_ready();
  } else if (doubt_ == Doubt::kMisfit) {
    node_.set_degraded("not localised: the scans do not fit the map at the pose, searching");
  } else {
    node_.set_degraded("not localised: more than one place is possible");
  }
}

void AmclNode::handle_clock_jump() {
  if (last_scan_ == Time{} || node_.now() >= last_scan_) return;
  odometry_.clear();
  scans_.clear();
  last_scan_ = saved_ = Time{};
}

void AmclNode::take(const Estimate& estimate, const Pose2& base_in_odom) {
  doubt_ = estimate.doubt;
  if (!estimate.localised) {
    track_in_map_.reset();
    return;
  }
  track_in_map_ = estimate.odom_in_map;
  if (estimate.updated) {
    pose_publisher_.publish(
        conversions::to_msg(Stamped<PoseEstimate>{estimate.stamp, "map", estimate.robot_in_map}));
  }
  if (node_.now() - saved_ >= seconds(config_.save_period)) save_pose(estimate, base_in_odom);
}

void AmclNode::save_pose(const Estimate& estimate, const Pose2& base_in_odom) {
  saved_ = node_.now();
  try {
    write_file_atomically(saved_path(), to_text({.stamp = estimate.stamp,
                                                 .map_hash = map_hash_,
                                                 .robot_in_map = estimate.robot_in_map,
                                                 .base_in_odom = base_in_odom}));
  } catch (const std::exception& problem) {
    if (node_.log().is_due("not saved", std::chrono::minutes(1))) {
      node_.log().warning("pose not saved: {}", problem.what());
    }
  }
}

void AmclNode::publish_transform() {
  if (!track_in_map_) return;
  node_.publish_transform("map", "odom", node_.now() + seconds(config_.transform_ahead),
                          *track_in_map_ * odometry_.odom_in_track());
}

void AmclNode::publish_cloud() {
  if (!cloud_publisher_.has_subscribers() || filter_.particles().empty()) return;
  Stamped<std::vector<Pose2>> cloud{node_.now(), "map", {}};
  const std::size_t count = filter_.particles().size();
  const std::size_t stride = 1 + (count - 1) / static_cast<std::size_t>(config_.cloud_size);
  for (std::size_t i = 0; i < count; i += stride)
    cloud.value.push_back(filter_.particles().pose(i));
  cloud_publisher_.publish(conversions::to_pose_array_msg(cloud));
}

}  // namespace coop::amcl
