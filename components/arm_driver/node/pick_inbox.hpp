#pragma once
#include <coop_msgs/msg/Pick.h>

#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "arm_driver/pick_sequence.hpp"
#include "core/config/fields.hpp"
#include "core/transform_buffer.hpp"

namespace coop::arm_driver {

struct PickInboxConfig {
  double max_transform_age = 1.0;   ///< s
  double transform_patience = 2.0;  ///< s

  void describe(config::Fields& fields);
};

/// Orders that came by message, until it is known where in base_link their eggs lie.
class PickInbox {
 public:
  /// `is_known`: asked whether an order of that name is running or ended, so that its place plays
  /// no part any more. `transforms` must outlive the inbox.
  PickInbox(const PickInboxConfig& config, const TransformBuffer& transforms,
            std::function<bool(std::string_view)> is_known);

  void receive(const coop_msgs::msg::Pick& message, Time now);

  /// The orders whose place has become known, or is given up, in the order they came. Holds until
  /// the next call.
  [[nodiscard]] const std::vector<PickOrder>& take(Time now);

 private:
  struct Waiting {
    PickOrder order;
    std::string frame;
    Result<Eigen::Vector3d> egg_in_frame;
    Time since;
  };
  /// False while there is hope for the place.
  [[nodiscard]] bool place(Waiting& waiting, Time now) const;
  [[nodiscard]] Result<Pose3> frame_in_base(const std::string& frame, Time now) const;

  PickInboxConfig config_;
  const TransformBuffer& transforms_;
  std::function<bool(std::string_view)> is_known_;
  std::deque<Waiting> waiting_;
  std::vector<PickOrder> placed_;
};

}  // namespace coop::arm_driver
