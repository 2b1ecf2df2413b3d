#include "launcher/dds_base.hpp"

#include <chrono>
#include <cmath>

#include "coop_msgs/msg/EmergencyStop.h"
#include "nav_msgs/msg/Odometry.h"
#include "runtime/transport.hpp"

namespace coop::launcher {
namespace {

using Wall = std::chrono::steady_clock;

constexpr double kStands = 0.01;  ///< m/s and rad/s
/// Odometry comes 50 times a second.
constexpr std::chrono::milliseconds kFresh{300};

}  // namespace

struct DdsBase::Impl {
  runtime::Transport& transport;
  std::unique_ptr<runtime::Writer> stop;
  std::unique_ptr<runtime::Reader> odometry;
  Motion last = Motion::kUnknown;
  Wall::time_point heard{};

  void tell(bool engaged) {
    coop_msgs::msg::EmergencyStop message;
    message.source("launcher");
    message.engaged(engaged);
    message.reason(engaged ? "the system stops" : "");
    stop->write(&message);
  }
};

DdsBase::DdsBase(runtime::Transport& transport)
    : impl_(new Impl{transport,
                     transport.create_writer("emergency_stop",
                                             runtime::message_type<coop_msgs::msg::EmergencyStop>(),
                                             runtime::Qos::kStateLatched),
                     nullptr}) {
  impl_->tell(false);
}
DdsBase::~DdsBase() = default;

void DdsBase::halt() {
  impl_->odometry = impl_->transport.create_reader(
      "odom", runtime::message_type<nav_msgs::msg::Odometry>(), runtime::Qos::kSensorStream, [] {});
  impl_->tell(true);
}

Base::Motion DdsBase::motion() {
  if (!impl_->odometry || impl_->odometry->matched_writers() == 0) return Motion::kNone;
  runtime::Sample sample;
  while (impl_->odometry->take(sample)) {
    const auto& message = *static_cast<const nav_msgs::msg::Odometry*>(sample.message.get());
    const auto& twist = message.twist().twist();
    const bool stands =
        std::abs(twist.linear().x()) < kStands && std::abs(twist.angular().z()) < kStands;
    impl_->last = stands ? Motion::kAtRest : Motion::kMoving;
    impl_->heard = Wall::now();
  }
  return Wall::now() - impl_->heard < kFresh ? impl_->last : Motion::kUnknown;
}

}  // namespace coop::launcher
