#pragma once
#include <cstdint>
#include <deque>
#include <optional>

#include "core/time.hpp"

namespace coop::capture {

/// Least, mean, most and standard deviation of the values seen.
struct Spread {
  double least = 0.0;
  double mean = 0.0;
  double most = 0.0;
  double deviation = 0.0;
};

/// What arrived on a topic within a window: rate, size, and how old messages were.
class TopicStatistics {
 public:
  /// `window`: messages considered, at least 2.
  explicit TopicStatistics(std::size_t window) : window_(window < 2 ? 2 : window) {}

  /// `delay`: from its writing (or its stamp) to its arrival.
  void add(Time arrival, std::size_t bytes, std::optional<Duration> delay);

  [[nodiscard]] std::uint64_t messages() const { return messages_; }
  /// Hz, bytes/s and seconds between two messages. Nothing before the second message.
  struct Flow {
    double rate = 0.0;
    double bytes_per_second = 0.0;
    Spread period;  ///< s
    Spread size;    ///< bytes
    std::size_t window = 0;
  };
  [[nodiscard]] std::optional<Flow> flow() const;
  /// Seconds. Nothing before the first message with a delay.
  [[nodiscard]] std::optional<Spread> delay() const;

 private:
  struct Arrival {
    Time time;
    std::size_t bytes = 0;
    std::optional<Duration> delay;
  };
  std::size_t window_;
  std::uint64_t messages_ = 0;
  std::deque<Arrival> arrivals_;
};

}  // namespace coop::capture
