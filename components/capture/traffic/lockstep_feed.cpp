#include "capture/traffic/lockstep_feed.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace coop::capture {
namespace {

/// Log times are those of the recorder's clock, which may lag behind the ticks that far.
constexpr Duration kLookahead = std::chrono::seconds(30);

}  // namespace

LockstepFeed::LockstepFeed(PlayList& list, LockstepScript script)
    : list_(list), script_(std::move(script)) {
  list_.rewind();
  ahead_ = list_.next();
  while (tick_ < script_.ticks().size() && script_.ticks()[tick_].time < list_.begin()) ++tick_;
  read_until(list_.begin() + kLookahead);
  if (const auto early = waiting_.find(0); early != waiting_.end()) {
    before_ = std::move(early->second);
    waiting_.erase(early);
    sort(before_);
  }
}

std::vector<std::size_t> LockstepFeed::channel_order() const {
  std::vector<std::size_t> order(list_.channels().size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [this](std::size_t channel) {
    return script_.rank_of(list_.channels()[channel].writer);
  };
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

void LockstepFeed::sort(std::vector<PlayMessage>& messages) const {
  std::ranges::stable_sort(messages, [this](const PlayMessage& a, const PlayMessage& b) {
    if (a.channel == b.channel) return a.sequence < b.sequence;
    return script_.rank_of(list_.channels()[a.channel].writer) <
           script_.rank_of(list_.channels()[b.channel].writer);
  });
}

void LockstepFeed::read_until(Time log_time) {
  while (ahead_ && ahead_->log_time <= log_time) {
    const auto tick = script_.tick_of(list_.channels()[ahead_->channel].writer, ahead_->sequence);
    if (tick) waiting_[*tick].push_back(std::move(*ahead_));
    ahead_ = list_.next();
  }
}

std::optional<LockstepFeed::Tick> LockstepFeed::next() {
  if (tick_ >= script_.ticks().size()) return std::nullopt;
  const LockstepScript::Tick& now = script_.ticks()[tick_++];
  if (now.time > list_.end()) return std::nullopt;
  read_until(now.time + kLookahead);
  Tick tick{.time = now.time, .messages = {}};
  while (!waiting_.empty() && waiting_.begin()->first <= now.number) {
    auto& [number, messages] = *waiting_.begin();
    if (number < now.number) {
      throw std::runtime_error("a message of " +
                               list_.channels()[messages.front().channel].recorded_topic +
                               " comes after its tick: the capture is not complete");
    }
    tick.messages = std::move(messages);
    waiting_.erase(waiting_.begin());
  }
  sort(tick.messages);
  return tick;
}

}  // namespace coop::capture
