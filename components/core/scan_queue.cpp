#include "core/scan_queue.hpp"

#include <utility>

namespace coop {

void ScanQueue::push(LaserScan scan) {
  if (waiting_.size() >= rules_.limit) drop("time: too many scans wait");
  waiting_.push_back(std::move(scan));
}

std::optional<LocatedScan> ScanQueue::next(const OdometryTrack& odometry,
                                           const TransformBuffer& transforms, Time now) {
  while (!waiting_.empty()) {
    LaserScan& scan = waiting_.front();
    const auto begin = odometry.at(scan.stamp);
    const auto end = rules_.whole_sweep ? odometry.at(scan.stamp + scan.sweep_duration()) : begin;
    const auto mount = transforms.lookup("base_link", scan.frame_id, scan.stamp);
    const bool torn = begin && end && begin->piece != end->piece;
    if (begin && end && mount && !torn) {
      LocatedScan located{std::move(scan), *begin,
                          begin->base_in_odom.inverse() * end->base_in_odom, to_pose2(*mount)};
      waiting_.pop_front();
      return located;
    }
    const auto hopeless = [](const auto& fix) {
      return !fix && fix.error() != OdometryTrack::Absence::kNotYet;
    };
    const bool too_long = rules_.patience != Duration::max() && now - scan.stamp > rules_.patience;
    if (!torn && !hopeless(begin) && !hopeless(end) && !too_long) return std::nullopt;
    drop(begin && end && !torn ? "mount of " + scan.frame_id : "odometry at their stamp");
  }
  return std::nullopt;
}

void ScanQueue::drop(std::string lack) {
  waiting_.pop_front();
  ++dropped_;
  lack_ = std::move(lack);
}

}  // namespace coop
