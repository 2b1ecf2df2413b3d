#include "slam/node/slam_node.hpp"

#include <nav_msgs/msg/Odometry.h>
#include <sensor_msgs/msg/LaserScan.h>

#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "conversions/time.hpp"
#include "core/atomic_file.hpp"
#include "core/map/map_file.hpp"
#include "slam/trajectory_file.hpp"

namespace coop::slam {

using runtime::Qos;

namespace {

constexpr auto kPeriod = std::chrono::milliseconds(20);
constexpr int kScansPerCall = 4;
constexpr std::size_t kMaxWaiting = 100'000;
constexpr auto kComplaintPeriod = std::chrono::seconds(10);

}  // namespace

void SlamNodeConfig::describe(config::Fields& fields) {
  fields.text(
      "save_path", save_path,
      {.help =
           "map and trajectory at exit: <path>.pgm, .yaml and _trajectory.txt; empty: not saved"});
  fields.integer(
      "threads", threads,
      {.help = "that share the particles; the result does not depend on it", .min = 1, .max = 64});
  fields.number("map_period", map_period,
                {.unit = "s", .help = "between maps, while they change", .min = 0.1, .max = 600});
  fields.number("transform_period", transform_period,
                {.unit = "s", .help = "between map -> odom", .min = 0.01, .max = 0.1});
  fields.number("transform_tolerance", transform_tolerance,
                {.unit = "s", .help = "map -> odom is dated ahead by", .min = 0.0, .max = 1.0});
  fields.number(
      "scan_timeout", scan_timeout,
      {.unit = "s", .help = "without a scan until degraded; 0: never", .min = 0.0, .max = 3600});
  fields.number("odometry_patience", odometry_patience,
                {.unit = "s",
                 .help = "a scan waits for its odometry; with reliable streams for ever",
                 .min = 0.1,
                 .max = 600});
  slam.describe(fields);
}

SlamNode::SlamNode(runtime::Node& node, const Config& config)
    : node_(node),
      config_(config),
      workers_(config.threads),
      transforms_(node.transforms()),
      map_publisher_(node.advertise<nav_msgs::msg::OccupancyGrid>("map", Qos::kStateLatched)),
      result_publisher_(
          node.advertise<coop_msgs::msg::SaveMapResult>("save_map_result", Qos::kEvent)) {
  start_anew();
  subscribe();
  node.every(kPeriod, [this] {
    clock_ = node_.now();
    process_scans(kScansPerCall);
  });
  node.advertise_transforms();
  node.every(seconds(config.transform_period), [this] { publish_transform(); });
  node.every(seconds(config.map_period), [this] { publish_map(); });
  node.every(std::chrono::milliseconds(500), [this] { report_health(); });
  node.on_clock_jump([this] { handle_clock_jump(); });
  node.on_stop([this] { finish(); });
}

/// The clock's first word is no reason to forget what came just before it.
void SlamNode::handle_clock_jump() {
  if (clock_ == Time{} || node_.now() >= clock_) return;
  if (filter_->has_map()) node_.log().warning("the clock was set back: the map starts anew");
  start_anew();
}

void SlamNode::start_anew() {
  filter_ = std::make_unique<ParticleFilter>(config_.slam, node_.random("particles")(), workers_);
  odometry_.clear();
  waiting_.clear();
  last_scan_ = Time{};
  newest_scan_ = Time{};
}

void SlamNode::subscribe() {
  node_.subscribe<nav_msgs::msg::Odometry>(
      "odom", Qos::kSensorStream, [this](const nav_msgs::msg::Odometry& message) {
        const auto odometry = conversions::from_msg(message);
        if (odometry) {
          odometry_.insert({odometry->odometry.stamp, odometry->odometry.base_in_odom});
        } else if (node_.log().is_due("bad odometry", kComplaintPeriod)) {
          node_.log().warning("odometry refused: {}", odometry.error());
        }
      });
  node_.subscribe<sensor_msgs::msg::LaserScan>(
      "scan", Qos::kSensorStream, [this](const sensor_msgs::msg::LaserScan& message) {
        auto scan = conversions::from_msg(message);
        if (!scan) {
          if (node_.log().is_due("bad scan", kComplaintPeriod))
            node_.log().warning("scan refused: {}", scan.error());
          return;
        }
        // A log's player that was killed tells the last scans again.
        if (scan->stamp < newest_scan_) return;
        newest_scan_ = scan->stamp;
        if (waiting_.size() >= kMaxWaiting) {
          waiting_.pop_front();
          ++dropped_;
        }
        waiting_.push_back(std::move(*scan));
        last_scan_ = node_.now();
      });
  node_.subscribe<coop_msgs::msg::SaveMap>(
      "save_map", Qos::kEvent, [this](const coop_msgs::msg::SaveMap& message) { answer(message); });
}

bool SlamNode::process_scans(int limit) {
  bool any = false;
  for (int i = 0; i < limit && !waiting_.empty(); ++i) {
    if (!process(waiting_.front())) break;
    waiting_.pop_front();
    any = true;
  }
  return any;
}

/// False where the scan has to wait.
bool SlamNode::process(const LaserScan& scan) {
  const auto base_in_odom = odometry_.at(scan.stamp);
  const auto end_in_odom = odometry_.at(scan.stamp + scan.sweep_duration());
  const auto laser_in_base = transforms_.lookup("base_link", scan.frame_id, scan.stamp);
  if (base_in_odom && end_in_odom && laser_in_base) {
    const Pose2 sweep = base_in_odom->inverse() * *end_in_odom;
    const auto outcome = filter_->update(scan, *base_in_odom, to_pose2(*laser_in_base), sweep);
    ++taken_;
    used_ += outcome.used ? 1 : 0;
    map_changed_ = map_changed_ || outcome.used;
    return true;
  }
  const bool too_old = !base_in_odom && base_in_odom.error() == OdometryTrack::Absence::kTooOld;
  const bool too_long = !node_.options().reliable_streams &&
                        node_.now() - scan.stamp > seconds(config_.odometry_patience);
  if (!too_old && !too_long) return false;
  ++dropped_;
  if (node_.log().is_due("scan dropped", kComplaintPeriod)) {
    node_.log().warning("{} scans dropped so far: no {} at their stamp", dropped_,
                        base_in_odom && end_in_odom ? "mount of " + scan.frame_id : "odometry");
  }
  return true;
}

void SlamNode::publish_transform() {
  if (!filter_->has_map()) return;
  node_.publish_transform("map", "odom", node_.now() + seconds(config_.transform_tolerance),
                          filter_->odom_in_map());
}

void SlamNode::publish_map() {
  if (!map_changed_) return;
  map_changed_ = false;
  map_publisher_.publish(
      conversions::to_msg(Stamped<OccupancyGrid>{node_.now(), "map", filter_->map()}));
}

void SlamNode::report_health() {
  const Time now = node_.now();
  // Half of the patience: at the whole of it the scan is gone.
  const bool waits =
      !waiting_.empty() && now - waiting_.front().stamp > seconds(0.5 * config_.odometry_patience);
  if (waits && !odometry_.at(waiting_.front().stamp)) {
    node_.set_degraded("no odometry for the scans");
  } else if (waits && !node_.options().reliable_streams) {
    node_.set_degraded("scans wait: too many, or the mount of the laser is not known");
  } else if (config_.scan_timeout > 0.0 && last_scan_ != Time{} &&
             now - last_scan_ > seconds(config_.scan_timeout)) {
    node_.set_degraded("no scan");
  } else {
    node_.set_ready();  // also before the first scan: nothing was promised yet
  }
}

void SlamNode::answer(const coop_msgs::msg::SaveMap& request) {
  coop_msgs::msg::SaveMapResult result;
  result.header(conversions::to_header(node_.now(), "map"));
  result.request_id(request.request_id());
  const std::string& path = request.path().empty() ? config_.save_path : request.path();
  result.path(path);
  try {
    if (path.empty()) throw std::runtime_error("neither the request nor save_path names a file");
    if (!filter_->has_map()) throw std::runtime_error("there is no map yet");
    save(path);
    result.success(true);
  } catch (const std::exception& problem) {
    result.success(false);
    result.detail(problem.what());
    node_.log().error("map not saved: {}", problem.what());
  }
  result_publisher_.publish(result);
}

/// A relative path lies in the folder of this run.
void SlamNode::save(const std::filesystem::path& path) {
  const std::filesystem::path stem = node_.options().run_dir / map::stem_of(path);
  map::save_map(filter_->map(), stem);
  write_file_atomically(
      stem.string() + "_trajectory.txt",
      to_text(interpolate_trajectory(filter_->trajectory(), odometry_.readings())));
  node_.log().info("saved {}.yaml", stem.string());
}

void SlamNode::finish() {
  if (!waiting_.empty()) node_.log().info("{} scans wait and are mapped first", waiting_.size());
  while (process_scans(1)) {
  }
  dropped_ += waiting_.size();
  node_.log().info("{} scans taken, {} of them drawn into the map", taken_, used_);
  if (dropped_ > 0)
    node_.log().warning("{} scans were not mapped for want of odometry or mount", dropped_);
  if (config_.save_path.empty()) return;
  try {
    if (!filter_->has_map()) throw std::runtime_error("there is none");
    save(config_.save_path);
  } catch (const std::exception& problem) {
    node_.fail(std::string("map not saved: ") + problem.what());
  }
}

}  // namespace coop::slam
