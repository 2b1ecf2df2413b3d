#include "slam/node/slam_node.hpp"

#include <nav_msgs/msg/Odometry.h>
#include <sensor_msgs/msg/LaserScan.h>

#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "conversions/time.hpp"
#include "core/atomic_file.hpp"
#include "core/map/map_file.hpp"
#include "core/name.hpp"
#include "slam/trajectory_file.hpp"

namespace coop::slam {

using runtime::Qos;

namespace {

constexpr auto kPeriod = std::chrono::milliseconds(20);
constexpr int kScansPerCall = 4;
constexpr std::size_t kMostReadings = 4'000'000;     // a day at 50 Hz
constexpr std::size_t kMostScansWaiting = 100;       // 10 s of a live stream
constexpr std::size_t kMostScansOfLog = 100'000;     // of a log, none is to be left out
constexpr std::size_t kScansToFindThePlaceIn = 100;  // in the map of a session
constexpr auto kComplaintPeriod = std::chrono::seconds(10);

}  // namespace

SlamNode::SlamNode(runtime::Node& node, const Config& config)
    : node_(node),
      config_(config),
      workers_(config.threads),
      transforms_(node.transforms()),
      odometry_(kMostReadings, config.odometry_restart),
      waiting_({.patience = node.options().reliable_streams ? Duration::max()
                                                            : seconds(config.odometry_patience),
                .limit = node.options().reliable_streams ? kMostScansOfLog : kMostScansWaiting}),
      keeper_(config.session.empty() ? "" : node.options().run_dir / config.session),
      map_publisher_(node.advertise<nav_msgs::msg::OccupancyGrid>("map", Qos::kStateLatched)),
      result_publisher_(
          node.advertise<coop_msgs::msg::SaveMapResult>("save_map_result", Qos::kEvent)) {
  start_anew();
  if (config.resume) resume();
  subscribe();
  node.every(kPeriod, [this] {
    clock_ = node_.now();
    process_scans(kScansPerCall);
  });
  node.advertise_transforms();
  node.every(seconds(config.transform_period), [this] { publish_transform(); });
  node.every(seconds(config.map_period), [this] { publish_map(); });
  node.every(std::chrono::milliseconds(500), [this] { report_health(); });
  // In lockstep a successor must find what was kept in the tick, not what the disk had time for.
  node.every(seconds(config.session_period), [this] { keep_session(node_.options().lockstep); });
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
  resumed_ = false;
  lost_ = 0;
}

void SlamNode::resume() {
  const auto found = keeper_.load();
  if (!found) return;
  const Result<Session>& session = *found;
  if (!session || session->map.resolution() != config_.slam.resolution) {
    node_.log().warning("the map starts anew: {} {}", keeper_.path().string(),
                        session ? "has another resolution" : session.error());
    return;
  }
  filter_->resume(session->map, session->nodes);
  odometry_.resume(track_of(*session), session->odom_in_track, session->odometry_source);
  resumed_ = map_changed_ = true;
  node_.log().info("goes on with the map of {}, {} scans", keeper_.path().string(),
                   session->nodes.size());
}

void SlamNode::take_odometry(const StampedPose2& base_in_odom, std::string_view source) {
  if (resumed_ && !odometry_.readings().empty()) {
    const Duration age = base_in_odom.stamp - odometry_.readings().back().stamp;
    if (age < -std::chrono::seconds(1) || age > seconds(config_.session_age)) {
      node_.log().warning("the session is of another time, {:.0f} s ago: the map starts anew",
                          to_seconds(age));
      start_anew();
    }
  }
  if (odometry_.insert(base_in_odom, source))
    node_.log().warning("odometry was restarted: the robot is sought around its last pose");
}

/// What a successor needs, if a scan was drawn since the last time.
void SlamNode::keep_session(bool wait) {
  const auto tell = [this](const std::optional<std::string>& problem) {
    if (problem && node_.log().is_due("session", kComplaintPeriod))
      node_.log().warning("session not kept: {}", *problem);
  };
  tell(keeper_.take_problem(wait));
  if (!keeper_.is_active() || used_ == kept_ || !filter_->has_map() || filter_->lost()) return;
  Session session{filter_->tiles(), filter_->trajectory(), odometry_.readings().back(),
                  odometry_.odom_in_track(), odometry_.source()};
  if (keeper_.begin_save(std::move(session))) kept_ = used_;
  if (wait) tell(keeper_.take_problem(true));
}

void SlamNode::subscribe() {
  node_.subscribe<nav_msgs::msg::Odometry>(
      "odom", Qos::kSensorStream,
      [this](const nav_msgs::msg::Odometry& message, const runtime::MessageInfo& info) {
        const auto odometry = conversions::from_msg(message);
        if (odometry) {
          take_odometry({odometry->odometry.stamp, odometry->odometry.base_in_odom}, info.writer);
        } else if (node_.log().is_due("bad odometry", kComplaintPeriod)) {
          node_.log().warning("odometry refused: {}", odometry.error());
        }
      },
      runtime::Attention::kPatient);
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
        waiting_.push(std::move(*scan));
        last_scan_ = node_.now();
      });
  node_.subscribe<coop_msgs::msg::SaveMap>(
      "save_map", Qos::kEvent, [this](const coop_msgs::msg::SaveMap& message) { answer(message); });
}

bool SlamNode::process_scans(int limit) {
  bool any = false;
  for (int i = 0; i < limit; ++i) {
    const auto located = waiting_.next(odometry_, transforms_, node_.now());
    if (!located) break;
    process(*located);
    any = true;
  }
  if (waiting_.dropped() != dropped_ && node_.log().is_due("scan dropped", kComplaintPeriod)) {
    dropped_ = waiting_.dropped();
    node_.log().warning("{} scans dropped so far: no {}", dropped_, waiting_.lack());
  }
  return any;
}

void SlamNode::process(const LocatedScan& located) {
  const auto outcome =
      filter_->update(located.scan, located.base_in_track, located.laser_in_base, located.sweep);
  ++taken_;
  used_ += outcome.used ? 1 : 0;
  map_changed_ = map_changed_ || outcome.used;
  lost_ = outcome.lost ? lost_ + 1 : 0;
  resumed_ = resumed_ && !outcome.used;
  if (resumed_ && lost_ >= kScansToFindThePlaceIn) {
    node_.log().warning("the robot is nowhere near where the session left it: the map starts anew");
    start_anew();
  }
}

void SlamNode::publish_transform() {
  if (!filter_->has_map() || filter_->lost()) return;
  node_.publish_transform("map", "odom", node_.now() + seconds(config_.transform_tolerance),
                          filter_->odom_in_map() * odometry_.odom_in_track());
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
  } else if (lost_ > 0) {
    node_.set_degraded("the scans do not fit the map near the last pose");
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
    if (!request.path().empty() && !is_name(path)) {
      throw std::runtime_error("'" + path + "' is no name: maps go into the folder of the run");
    }
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
  while (process_scans(1)) node_.keep_alive();
  node_.log().info("{} scans taken, {} of them drawn into the map", taken_, used_);
  if (const std::size_t missing = waiting_.dropped() + waiting_.size(); missing > 0)
    node_.log().warning("{} scans were not mapped for want of odometry or mount", missing);
  keep_session(true);
  if (config_.save_path.empty()) return;
  try {
    if (!filter_->has_map()) throw std::runtime_error("there is none");
    save(config_.save_path);
  } catch (const std::exception& problem) {
    node_.fail(std::string("map not saved: ") + problem.what());
  }
}

}  // namespace coop::slam
