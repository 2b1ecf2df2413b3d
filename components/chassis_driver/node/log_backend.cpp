#include "chassis_driver/node/log_backend.hpp"

#include <algorithm>
#include <stdexcept>

#include "chassis_driver/node/chassis_driver_node.hpp"
#include "conversions/time.hpp"

namespace coop::chassis_driver {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(5);
/// Spent at a time on waiting for readers.
constexpr Duration kGlance = std::chrono::milliseconds(50);
/// Readings under way that readers need not have taken in yet; far less than what a write would
/// block at, where no heart beats.
constexpr std::size_t kWindow = 500;
/// Busy readers acknowledge late, and what was written since hides it: so long after the last time
/// that all was acknowledged the playback holds until it is, or a later life would repeat much.
constexpr Duration kLongestDoubt = std::chrono::milliseconds(300);
/// Steps a call: long enough to be fast, short enough to beat the heart and hear signals in
/// between.
constexpr int kStepsPerCall = 100;
/// Those who heard an earlier life are waited for so long, by wall time; one may have left for
/// good.
constexpr Duration kReadersReturn = std::chrono::seconds(2);
/// Between reminders of the log's last time, by wall time.
constexpr Duration kReminder = std::chrono::milliseconds(100);

std::filesystem::path position_file(const runtime::Node& node) {
  return node.options().run_dir / (node.name() + ".position");
}

}  // namespace

LogBackend::LogBackend(runtime::Node& node, const LogConfig& config, OdometryLog log)
    : node_(node),
      log_(std::move(log)),
      playback_(config.playback, log_.begin(), log_.end()),
      output_(node),
      clock_(node.advertise<rosgraph_msgs::msg::Clock>("clock", runtime::Qos::kEvent)),
      position_(position_file(node), {log_.size(), playback_.begin(), playback_.end()}),
      readers_(config.readers),
      stays_(config.at_end == "stay"),
      settle_(seconds(config.settle)),
      patience_(seconds(config.patience)) {
  if (node.options().sim_time) {
    throw std::runtime_error("a log's player is the master of time: start it without --sim-time");
  }
  while (next_ < log_.size() && log_[next_].stamp < playback_.begin()) ++next_;
  if (config.resume) resume();
  acknowledged_ = next_;
  node.log().info("{}: {} odometry readings, {:.1f} s", config.file, log_.size(),
                  to_seconds(log_.end() - log_.begin()));
  node.every(kPeriod, [this] { play(); });
}

void LogBackend::resume() {
  resumed_ = position_.found();
  if (!resumed_) return;
  next_ = std::max(next_, static_cast<std::size_t>(resumed_->taken));
  playback_.resume(resumed_->clock);
  node_.log().warning("goes on with reading {}, {:.1f} s into the log", next_,
                      to_seconds(playback_.begin() - log_.begin()));
}

bool LogBackend::readers_are_there() {
  if (readers_ == 0) return true;
  if (clock_.subscribers() < readers_ || output_.subscribers() < readers_) {
    heard_since_ = Time{};
    return false;
  }
  if (heard_since_ == Time{}) heard_since_ = node_.now();
  const Duration heard = node_.now() - heard_since_;
  if (resumed_ && output_.subscribers() < resumed_->readers && heard < kReadersReturn) return false;
  return heard >= settle_ / 2;
}

bool LogBackend::time_is_announced() {
  if (announced_at_ == Time{}) {
    // Readers may start anew when their clock jumps into the log's time; that must not cost them
    // its first reading. Later it would set the clock back.
    if (!resumed_ &&
        !clock_.publish(conversions::to_clock_msg(playback_.begin() - Playback::kStep))) {
      return false;
    }
    announced_at_ = node_.now();
  }
  return node_.now() - announced_at_ >= settle_ / 2;
}

void LogBackend::play() {
  if (playback_.at_end()) {
    finish();
    return;
  }
  if (!playback_.started() && !(readers_are_there() && time_is_announced())) return;
  look_for_acknowledgments();
  if (!readers_keep_up()) return;
  for (int i = 0; i < kStepsPerCall; ++i) {
    const auto step = playback_.next(node_.now());
    if (!step || !publish_until(*step)) return;
    playback_.advance(*step);
    if (next_ - acknowledged_ > kWindow) return;
  }
}

void LogBackend::look_for_acknowledgments() {
  if (acknowledged_ < next_ && output_.wait_for_acknowledgments(Duration{0})) acknowledged_ = next_;
  if (acknowledged_ == next_) sure_at_ = node_.now();
}

bool LogBackend::readers_keep_up() {
  if (next_ - acknowledged_ <= kWindow && node_.now() - sure_at_ <= kLongestDoubt) return true;
  if (!output_.wait_for_acknowledgments(kGlance)) return false;
  acknowledged_ = next_;
  sure_at_ = node_.now();
  return true;
}

bool LogBackend::publish_until(Time step) {
  while (next_ < log_.size() && log_[next_].stamp <= step) {
    if (!output_.publish(log_[next_], Eigen::Matrix3d::Zero())) return false;
    ++next_;
  }
  // The clock last: when a component hears that a time has come, the odometry up to it is under
  // way. On disk before it is told: no later life may tell an earlier time.
  position_.write({acknowledged_, step, output_.subscribers()});
  return clock_.publish(conversions::to_clock_msg(step));
}

void LogBackend::finish() {
  if (stays_) {
    remind();
    return;
  }
  if (ended_at_ == Time{}) ended_at_ = node_.now();
  const bool heard =
      output_.wait_for_acknowledgments(kGlance) && clock_.wait_for_acknowledgments(kGlance);
  if (heard) {
    position_.forget();
    node_.finish("the log was played to its end");
  } else if (node_.now() - ended_at_ > patience_) {
    node_.fail("the log was played, but not all readers acknowledged its end");
  }
}

/// Who starts late, or anew, must still hear that the time has come.
void LogBackend::remind() {
  look_for_acknowledgments();
  position_.write({acknowledged_, playback_.end(), output_.subscribers()});
  if (ended_at_ == Time{}) {
    ended_at_ = node_.now();
    node_.log().info("the log was played to its end");
  }
  if (node_.now() - reminded_at_ < kReminder) return;
  reminded_at_ = node_.now();
  // Refused where a reader does not keep up: then it has enough to hear.
  (void)clock_.publish(conversions::to_clock_msg(playback_.end()));
}

}  // namespace coop::chassis_driver
