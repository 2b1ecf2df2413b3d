#include "arm_driver/node/pick_inbox.hpp"

#include <algorithm>

#include "conversions/geometry.hpp"
#include "core/robot/robot_model.hpp"

namespace coop::arm_driver {

void PickInboxConfig::describe(config::Fields& fields) {
  fields.number(
      "max_transform_age", max_transform_age,
      {.unit = "s", .help = "of the robot's pose when a pick begins", .min = 0, .max = 60});
  fields.number("transform_patience", transform_patience,
                {.unit = "s", .help = "waiting for that pose", .min = 0, .max = 60});
}

PickInbox::PickInbox(const PickInboxConfig& config, const TransformBuffer& transforms,
                     std::function<bool(std::string_view)> is_known)
    : config_(config), transforms_(transforms), is_known_(std::move(is_known)) {}

void PickInbox::receive(const coop_msgs::msg::Pick& message, Time now) {
  const auto is_this = [&](const Waiting& waiting) {
    return waiting.order.pick_id == message.pick_id();
  };
  if (std::any_of(waiting_.begin(), waiting_.end(), is_this)) return;
  auto position = conversions::from_msg(message.position());
  if (message.header().frame_id().empty()) position = fail("frame_id is empty");
  waiting_.push_back(
      {{message.pick_id(), message.egg_id()}, message.header().frame_id(), position, now});
}

Result<Pose3> PickInbox::frame_in_base(const std::string& frame, Time now) const {
  if (frame == robot::kBaseLink) return Pose3::Identity();
  // The egg keeps its place in a fixed frame while the robot drives: what counts is where the robot
  // stands now, not where it stood at the order's stamp.
  const auto newest = transforms_.newest_stamp(robot::kBaseLink, frame);
  if (!newest) return fail(std::string(to_string(newest.error())));
  const Time stamp = *newest == Time::max() ? now : *newest;
  if (now - stamp > seconds(config_.max_transform_age)) return fail("it is too old");
  const auto pose = transforms_.lookup(robot::kBaseLink, frame, stamp);
  if (!pose) return fail(std::string(to_string(pose.error())));
  return *pose;
}

bool PickInbox::place(Waiting& waiting, Time now) const {
  if (is_known_(waiting.order.pick_id)) return true;
  auto& egg_in_base = waiting.order.egg_in_base;
  if (!waiting.egg_in_frame) {
    egg_in_base = fail(waiting.egg_in_frame.error());
    return true;
  }
  const auto pose = frame_in_base(waiting.frame, now);
  if (pose) {
    egg_in_base = Eigen::Vector2d((*pose * *waiting.egg_in_frame).head<2>());
    return true;
  }
  const bool hope =
      now >= waiting.since && now - waiting.since < seconds(config_.transform_patience);
  if (hope) return false;
  egg_in_base = fail("no transform from " + waiting.frame + " to base_link: " + pose.error());
  return true;
}

const std::vector<PickOrder>& PickInbox::take(Time now) {
  placed_.clear();
  while (!waiting_.empty() && place(waiting_.front(), now)) {
    placed_.push_back(std::move(waiting_.front().order));
    waiting_.pop_front();
  }
  return placed_;
}

}  // namespace coop::arm_driver
