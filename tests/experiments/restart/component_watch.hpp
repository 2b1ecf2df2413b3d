#pragma once
#include <chrono>
#include <map>
#include <optional>
#include <string>

#include "coop_msgs/msg/ComponentStatus.h"
#include "system/support/listener.hpp"

namespace coop::experiments {

using Wall = std::chrono::steady_clock;

/// What each component of a running system says of itself, and when it was last seen at work: every
/// one has an output of which a sample proves that it is there and has what it needs to work.
class ComponentWatch {
 public:
  explicit ComponentWatch(int domain);

  /// Takes in what arrives within `limit`, or at once where something is there.
  void look(std::chrono::milliseconds limit);

  struct Status {
    pid_t pid = 0;
    std::uint8_t state = 0;
    Wall::time_point since;  ///< in this state, with this pid
    Wall::time_point heard;
    std::string detail;
  };
  [[nodiscard]] std::optional<Status> status(const std::string& component) const;
  [[nodiscard]] bool is_ready(const std::string& component) const;

  /// When the first proof came from a process of `component` that nothing had been heard of before
  /// `since`.
  [[nodiscard]] std::optional<Wall::time_point> successor_at_work(const std::string& component,
                                                                  Wall::time_point since) const;
  /// When the newest proof came, of whatever process.
  [[nodiscard]] std::optional<Wall::time_point> last_at_work(const std::string& component) const;

  [[nodiscard]] runtime::Node& node() { return listener_.node(); }

 private:
  template <class Message>
  void prove(const std::string& component, const std::string& topic, runtime::Qos qos);
  void saw(const std::string& component, std::string_view writer);

  struct Seen {
    Wall::time_point first;
    Wall::time_point last;
  };
  test::Listener listener_;
  std::map<std::string, Status> statuses_;
  std::map<std::string, std::map<std::string, Seen, std::less<>>> writers_;
};

}  // namespace coop::experiments
