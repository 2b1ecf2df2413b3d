#pragma once
#include <deque>
#include <string>
#include <utility>

#include "core/time.hpp"
#include "core/transform_buffer.hpp"

namespace coop::runtime {

/// Messages that wait until the transform at their stamp is known. Give up on those whose transform
/// will not come or that waited longer than `patience` of the component's clock (Duration::max():
/// never).
template <class Item>
class StampedQueue {
 public:
  StampedQueue(std::string target, Duration patience, std::size_t limit)
      : target_(std::move(target)), patience_(patience), limit_(limit) {}

  /// `frame` is that of the item. Where the queue is full the oldest item makes room.
  void push(Item item, std::string frame, Time stamp) {
    if (waiting_.size() >= limit_) {
      waiting_.pop_front();
      ++dropped_;
    }
    waiting_.push_back({std::move(item), std::move(frame), stamp});
  }

  /// Calls handle(item, item_frame_in_target) for all at the front whose transform is known, in
  /// order.
  template <class Handle>
  void process(const TransformBuffer& transforms, Time now, Handle&& handle) {
    while (!waiting_.empty()) {
      Waiting& front = waiting_.front();
      const auto pose = transforms.lookup(target_, front.frame, front.stamp);
      if (!pose) {
        const bool hopeless = pose.error() == TransformError::kTooOld ||
                              (patience_ != Duration::max() && now - front.stamp > patience_);
        last_error_ = pose.error();
        if (!hopeless) return;
        ++dropped_;
        waiting_.pop_front();
        continue;
      }
      Item item = std::move(front.item);
      waiting_.pop_front();
      handle(std::move(item), *pose);
    }
  }

  [[nodiscard]] std::size_t size() const { return waiting_.size(); }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  [[nodiscard]] TransformError last_error() const { return last_error_; }
  void clear() { waiting_.clear(); }

 private:
  struct Waiting {
    Item item;
    std::string frame;
    Time stamp;
  };
  std::string target_;
  Duration patience_;
  std::size_t limit_;
  std::deque<Waiting> waiting_;
  std::uint64_t dropped_ = 0;
  TransformError last_error_ = TransformError::kNotYet;
};

}  // namespace coop::runtime
