#include "chassis_driver/node/odometry_output.hpp"

#include "conversions/navigation.hpp"

namespace coop::chassis_driver {

OdometryOutput::OdometryOutput(runtime::Node& node)
    : node_(node),
      odom_(node.advertise<nav_msgs::msg::Odometry>("odom", runtime::Qos::kSensorStream)) {
  node.advertise_transforms();
}

bool OdometryOutput::publish(const Odometry& odometry, const Eigen::Matrix3d& covariance) {
  conversions::FramedOdometry framed;
  framed.odometry = odometry;
  framed.covariance = covariance;
  if (!odom_.publish(conversions::to_msg(framed))) return false;
  node_.publish_transform(framed.frame_id, framed.child_frame_id, odometry.stamp,
                          odometry.base_in_odom);
  return true;
}

}  // namespace coop::chassis_driver
