#include "launcher/dds_health.hpp"

#include <sys/eventfd.h>

#include <cstdint>
#include <utility>

#include "coop_msgs/msg/ComponentStatus.h"
#include "coop_msgs/msg/MissionStatus.h"
#include "launcher/file_descriptor.hpp"
#include "runtime/transport.hpp"

namespace coop::launcher {
namespace {

/// A reader whose news can be waited for with poll().
template <class Message>
class Inbox {
 public:
  Inbox(runtime::Transport& transport, const std::string& topic, runtime::Qos qos)
      : event_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
        reader_(transport.create_reader(
            topic, runtime::message_type<Message>(), qos, [fd = event_.get()] {
              const std::uint64_t one = 1;
              [[maybe_unused]] const auto count = write(fd, &one, sizeof one);
            })) {}

  [[nodiscard]] int fd() const { return event_.get(); }

  template <class Handle>
  void drain(Handle handle) {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto got = read(event_.get(), &count, sizeof count);
    runtime::Sample sample;
    while (reader_->take(sample)) handle(*static_cast<const Message*>(sample.message.get()));
  }

 private:
  FileDescriptor event_;
  std::unique_ptr<runtime::Reader> reader_;
};

using coop_msgs::msg::ComponentStatus;
using coop_msgs::msg::MissionStatus;
namespace component_state = coop_msgs::msg::ComponentStatus_Constants;
namespace mission_state = coop_msgs::msg::MissionStatus_Constants;

Health health_of(std::uint8_t state) {
  switch (state) {
    case component_state::READY:
      return Health::kReady;
    case component_state::DEGRADED:
      return Health::kDegraded;
    case component_state::STOPPING:
      return Health::kStopping;
    case component_state::FINISHED:
      return Health::kFinished;
    default:
      return Health::kStarting;
  }
}

}  // namespace

struct DdsHealth::Impl {
  runtime::Transport& transport;
  Inbox<ComponentStatus> inbox;
  std::optional<std::string> mended = std::nullopt;
};

DdsHealth::DdsHealth(runtime::Transport& transport)
    : impl_(new Impl{transport, {transport, "component_status", runtime::Qos::kHeartbeat}}) {}
DdsHealth::~DdsHealth() = default;
int DdsHealth::wake_fd() const {
  return impl_->inbox.fd();
}

std::vector<Heartbeat> DdsHealth::take() {
  if (auto why = impl_->transport.mend()) impl_->mended = std::move(why);
  std::vector<Heartbeat> heartbeats;
  impl_->inbox.drain([&](const ComponentStatus& status) {
    heartbeats.push_back({.component = status.name(),
                          .health = health_of(status.state()),
                          .detail = status.detail(),
                          .pid = static_cast<pid_t>(status.pid()),
                          .host = status.host()});
  });
  return heartbeats;
}

std::optional<std::string> DdsHealth::mended() {
  return std::exchange(impl_->mended, std::nullopt);
}

struct MissionWatch::Impl {
  Inbox<MissionStatus> inbox;
};

MissionWatch::MissionWatch(runtime::Transport& transport)
    : impl_(new Impl{{transport, "mission_status", runtime::Qos::kStateLatched}}) {}
MissionWatch::~MissionWatch() = default;
int MissionWatch::wake_fd() const {
  return impl_->inbox.fd();
}

std::optional<MissionEnd> MissionWatch::take() {
  std::optional<MissionEnd> end;
  impl_->inbox.drain([&](const MissionStatus& status) {
    const bool done = status.state() == mission_state::DONE;
    if (done || status.state() == mission_state::FAILED) end = MissionEnd{done, status.detail()};
  });
  return end;
}

}  // namespace coop::launcher
