#pragma once
#include <chrono>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <functional>
#include <mutex>
#include <optional>

namespace coop::runtime {

/// What a participant knows of its discovery server.
class ServerWatch : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  using Wall = std::chrono::steady_clock;

  /// `on_found` is called on a thread of Fast DDS.
  explicit ServerWatch(std::function<void()> on_found) : on_found_(std::move(on_found)) {}

  [[nodiscard]] bool sees_server() const;
  /// Whether it saw the server once, and not for so long.
  [[nodiscard]] bool has_lost_server(Wall::duration ago) const;

  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;

 private:
  std::function<void()> on_found_;
  mutable std::mutex mutex_;
  bool sees_ = false;
  std::optional<Wall::time_point> lost_;
};

}  // namespace coop::runtime
