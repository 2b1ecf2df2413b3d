#pragma once
#include <set>

#include "core/time.hpp"
#include "system/support/listener.hpp"

namespace coop::test {

/// Hears all that a log's players say.
class LogWatch {
 public:
  explicit LogWatch(int domain);

  /// Takes in what has arrived.
  void look() { listener_.look(); }
  [[nodiscard]] const std::set<Time>& odometry() const { return odometry_; }
  [[nodiscard]] const std::set<Time>& scans() const { return scans_; }
  [[nodiscard]] int repeats() const { return repeats_; }  ///< readings and scans told twice
  [[nodiscard]] Time clock() const { return clock_time_; }
  [[nodiscard]] int clock_set_back() const { return clock_set_back_; }

 private:
  Listener listener_;
  std::set<Time> odometry_;
  std::set<Time> scans_;
  int repeats_ = 0;
  Time clock_time_{};
  int clock_set_back_ = 0;
};

}  // namespace coop::test
