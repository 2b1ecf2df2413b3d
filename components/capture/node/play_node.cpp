#include "capture/node/play_node.hpp"

#include <fmt/format.h>

#include <numeric>

#include "capture/node/lockstep_records.hpp"
#include "conversions/time.hpp"
#include "core/config/error.hpp"

namespace coop::capture {

using Wall = std::chrono::steady_clock;

namespace {

/// Discovery is thought to be over when no reader was unmatched for that long.
constexpr auto kSettled = std::chrono::milliseconds(500);
constexpr auto kLook = std::chrono::milliseconds(50);
/// As fast as possible: messages between two looks at the rest of the world.
constexpr int kBurst = 50;
/// Offers of one message, each some 200 ms long, before it is given up.
constexpr int kMostStalls = 100;

/// In lockstep what takes part speaks for itself.
PlaySelection selection_for(const runtime::Node& node, const PlayConfig& config) {
  PlaySelection selection = config.selection();
  const auto& members = node.options().members;
  selection.without.insert(selection.without.end(), members.begin(), members.end());
  return selection;
}

std::vector<std::size_t> as_listed(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

}  // namespace

void PlayNode::check(const Config& config) {
  if (config.file.empty()) throw config::Error("file: expected a capture to play");
  if (!std::filesystem::exists(config.file)) {
    throw config::Error("file: no capture '" + config.file + "'");
  }
}

PlayNode::PlayNode(runtime::Node& node, const Config& config)
    : node_(node),
      config_(config),
      list_(config.file, selection_for(node, config)),
      output_(node.options().lockstep ? make_lockstep_output(node)
                                      : make_wire_output(node, node.options().reliable_streams)),
      schedule_(config.rate) {
  if (config_.clock) {
    clock_ = node.advertise<rosgraph_msgs::msg::Clock>("clock", runtime::Qos::kEvent);
  }
  if (list_.was_cut()) node.log().warning("the capture was cut short: plays what is there");
  if (node.options().lockstep) {
    begin_lockstep();
    return;
  }
  output_->open(list_.channels(), as_listed(list_.channels().size()));
  if (config_.keyboard) {
    keyboard_.emplace();
    node.executor().add_wall_timer(std::chrono::milliseconds(20), [this] { handle_keys(); });
  }
  node.on_stop([this] { keyboard_.reset(); });
  opened_ = Wall::now();
  look_for_readers();
}

void PlayNode::begin_lockstep() {
  const auto rosters = recorded_rosters(list_);
  const auto orders = recorded_orders(list_);
  tick_ = list_.begin();
  if (!orders.empty()) {
    feed_.emplace(list_, LockstepScript(rosters, orders));
    output_->open(list_.channels(), feed_->channel_order());
    for (const PlayMessage& message : feed_->before()) publish(message);
    node_.log().info("plays a lockstep tick by tick");
  } else {
    output_->open(list_.channels(), as_listed(list_.channels().size()));
    for (const PlayMessage& message : list_.latched_before()) publish(message);
    next_ = list_.next();
  }
  node_.lead_time({.period = seconds(config_.clock_period), .rate = config_.rate, .step = [this] {
                     return step();
                   }});
}

Time PlayNode::step() {
  if (feed_) {
    const auto tick = feed_->next();
    if (!tick) {
      end();
      return tick_;
    }
    tick_ = tick->time;
    publish_clock(tick_);
    for (const PlayMessage& message : tick->messages) publish(message);
    return tick_;
  }
  publish_clock(tick_);
  for (; next_ && next_->log_time <= tick_; next_ = list_.next()) publish(*next_);
  const Time reached = tick_;
  tick_ += seconds(config_.clock_period);
  if (!next_) end();
  return reached;
}

void PlayNode::publish_clock(Time time) {
  if (config_.clock) clock_.publish(conversions::to_clock_msg(time));
}

bool PlayNode::publish(const PlayMessage& message) {
  if (output_->write(message)) {
    ++published_;
    return true;
  }
  ++refused_;
  if (node_.log().is_due("refused", std::chrono::seconds(5))) {
    node_.log().warning("{} messages of {} were not taken: a reader is too slow", refused_,
                        list_.channels()[message.channel].topic);
  }
  return false;
}

void PlayNode::look_for_readers() {
  const auto now = Wall::now();
  const bool matched = output_->is_matched(config_.readers);
  if (!matched) matched_ = {};
  if (matched && matched_ == PlaySchedule::Wall{}) matched_ = now;
  const bool settled = matched && now - std::max(matched_, opened_) >= kSettled;
  const bool late = now - opened_ >= seconds(config_.wait);
  if (late && !matched && !config_.readers.empty()) {
    return node_.fail(
        fmt::format("nobody reads {} within {} s", fmt::join(config_.readers, ", "), config_.wait));
  }
  if (settled || late) return begin();
  node_.executor().call_at(now + kLook, [this] { look_for_readers(); });
}

void PlayNode::begin() {
  node_.log().info("plays {:.1f} s of {} channels", to_seconds(list_.end() - list_.begin()),
                   list_.channels().size());
  for (const PlayMessage& message : list_.latched_before()) publish(message);
  next_ = list_.next();
  next_clock_ = config_.clock ? list_.begin() : Time::max();
  schedule_.start(list_.begin(), Wall::now());
  if (config_.paused) schedule_.pause(Wall::now());
  work();
}

void PlayNode::work() {
  int left = kBurst;
  while (left-- > 0 && publish_due(Wall::now())) {
  }
  if (!next_ && !config_.loop) return end();
  if (!next_) {
    list_.rewind();
    return begin();
  }
  call_for_next();
}

/// One message or one step of the clock, the earlier; the clock first where both are at once.
bool PlayNode::publish_due(PlaySchedule::Wall now) {
  if (!next_) return false;
  const Time moment = std::min(next_->log_time, next_clock_);
  if (!schedule_.is_due(moment, now)) return false;
  schedule_.move_to(moment);
  if (next_clock_ <= next_->log_time) {
    publish_clock(next_clock_);
    next_clock_ += seconds(config_.clock_period);
  } else {
    // Unpaced, the readers set the pace: what is not taken is offered again.
    const bool taken = config_.rate > 0.0 ? publish(*next_) : output_->write(*next_);
    if (!taken && config_.rate == 0.0 && ++stalls_ < kMostStalls) return false;
    if (config_.rate == 0.0) ++(taken ? published_ : refused_);
    stalls_ = 0;
    next_ = list_.next();
  }
  return true;
}

void PlayNode::call_for_next() {
  const auto due = schedule_.due(std::min(next_->log_time, next_clock_));
  if (due == PlaySchedule::Wall::max()) return;  // paused
  node_.executor().call_at(due, [this] { work(); });
}

void PlayNode::handle_keys() {
  while (const auto key = keyboard_ ? keyboard_->key() : std::nullopt) {
    if (*key == 'q') return node_.finish("stopped by key");
    if (!schedule_.started()) continue;
    if (*key == ' ' && schedule_.paused()) {
      schedule_.resume(Wall::now());
      node_.log().info("goes on");
      work();
    } else if (*key == ' ') {
      schedule_.pause(Wall::now());
      node_.log().info("paused at {:.3f} s: space goes on, n plays the next message, q ends",
                       to_seconds(schedule_.position(Wall::now()) - list_.begin()));
    } else if (*key == 'n' && schedule_.paused() && next_) {
      step_once();
    }
  }
}

/// To the next message, with the clock on the way.
void PlayNode::step_once() {
  schedule_.move_to(next_->log_time);
  while (next_clock_ <= next_->log_time) publish_due(Wall::now());
  node_.log().info("{:.3f} s: {}", to_seconds(next_->log_time - list_.begin()),
                   list_.channels()[next_->channel].topic);
  publish_due(Wall::now());
  if (!next_) end();
}

void PlayNode::end() {
  output_->wait_for_acknowledgments(std::chrono::seconds(2));
  node_.finish(fmt::format("played {} messages{}", published_,
                           refused_ == 0 ? "" : fmt::format(", {} were not taken", refused_)));
}

}  // namespace coop::capture
