#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"

namespace coop::robot {

/// Names that the robot's description and the programs agree on.
inline constexpr std::string_view kBaseLink = "base_link";
inline constexpr std::string_view kLaserLink = "laser_link";
inline constexpr std::string_view kImuLink = "imu_link";
inline constexpr std::string_view kCameraLink = "camera_link";
inline constexpr std::string_view kCameraOpticalFrame = "camera_optical_frame";
inline constexpr std::string_view kArmBaseLink = "arm_base_link";
inline constexpr std::string_view kSuctionCupLink = "suction_cup_link";
inline constexpr std::string_view kBasketLink = "basket_link";
inline constexpr std::string_view kScraperLink = "scraper_link";
inline constexpr std::string_view kWorkingPoint = "working_point";

enum class JointType { kFixed, kRevolute, kContinuous, kPrismatic, kFloating, kPlanar };

/// A joint and, at zero, where it puts its child: child_in_parent = origin * motion(axis,
/// position).
struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  std::string parent;
  std::string child;
  Pose3 origin = Pose3::Identity();                         ///< child in parent at position 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();          ///< unit vector in the child's frame
  double lower = -std::numeric_limits<double>::infinity();  ///< rad, or m for prismatic
  double upper = std::numeric_limits<double>::infinity();   ///< rad, or m for prismatic
  double max_velocity = 0.0;                                ///< rad/s or m/s; 0: not given
  double max_effort = 0.0;                                  ///< Nm or N; 0: not given

  [[nodiscard]] bool is_movable() const { return type != JointType::kFixed; }
  /// Child in parent at the position (rad or m); the position of a fixed joint is ignored. Floating
  /// and planar joints stay at their origin.
  [[nodiscard]] Pose3 child_in_parent(double position) const;
};

/// Box or upright cylinder (axis z of its own frame) of a link's collision model. Meshes and
/// spheres are left out.
struct CollisionShape {
  enum class Kind { kBox, kCylinder } kind = Kind::kBox;
  Pose3 in_link = Pose3::Identity();
  Eigen::Vector3d size =
      Eigen::Vector3d::Zero();  ///< m: box edges, or (diameter, diameter, length)
};

struct Link {
  std::string name;
  std::vector<CollisionShape> collision;
};

/// Bicycle view of a base with two steered front wheels and a driven rear axle at base_link.
struct AckermannGeometry {
  double wheelbase = 0.0;     ///< m, rear axle to front axle
  double track = 0.0;         ///< m, between the kingpins
  double wheel_radius = 0.0;  ///< m, of the driven rear wheels
  double max_steering_angle =
      0.0;  ///< rad, of the virtual middle wheel when the inner wheel is at its limit
  double max_steering_rate = 0.0;  ///< rad/s

  [[nodiscard]] double min_turning_radius() const;  ///< m, of base_link
};

/// A robot read from a URDF file and checked: one root, no loop, every link connected, all numbers
/// finite. Parsing is urdfdom's; what urdfdom accepts although it is no tree (a link with two
/// parents, a loop beside the tree) is refused here. All errors are config::Error with one line
/// that names the file and what is wrong.
class RobotModel {
 public:
  /// Reads and checks a URDF. Throws config::Error.
  static RobotModel load(const std::filesystem::path& path);
  /// The same from text; `source` stands for the file in messages.
  static RobotModel parse(const std::string& urdf, const std::string& source);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& urdf() const { return urdf_; }  ///< the text as read
  [[nodiscard]] const std::string& root() const { return links_.front().name; }
  /// Depth first from the root, so a parent comes before its children.
  [[nodiscard]] const std::vector<Link>& links() const { return links_; }
  [[nodiscard]] const std::vector<Joint>& joints() const { return joints_; }

  [[nodiscard]] bool has_link(std::string_view link) const;
  /// Throw config::Error where the name is unknown.
  [[nodiscard]] const Link& link(std::string_view name) const;
  [[nodiscard]] const Joint& joint(std::string_view name) const;

  /// Pose of `link` in `reference` where only fixed joints lie between them; throws config::Error
  /// otherwise.
  [[nodiscard]] Pose3 mount(std::string_view link, std::string_view reference = kBaseLink) const;

  /// The joints, fixed ones included, on the way down from `base` to its descendant `tip`; throws
  /// config::Error.
  [[nodiscard]] std::vector<Joint> chain(std::string_view base, std::string_view tip) const;
  [[nodiscard]] std::vector<Joint> arm() const { return chain(kArmBaseLink, kSuctionCupLink); }

  /// Convex outline of base_link's collision boxes seen from above, counter-clockwise, in
  /// base_link, m. Throws config::Error where there are none, or where the root is not base_link.
  [[nodiscard]] std::vector<Eigen::Vector2d> footprint() const;

  /// The blade of a cleaning robot: the collision box of scraper_link seen from above, in
  /// base_link, m, which it must be parallel to. Throws config::Error where there is none.
  [[nodiscard]] Eigen::AlignedBox2d scraper() const;

  /// From the joints *_steering_joint and rear_*_wheel_joint; throws config::Error where the base
  /// has none or they are not symmetric to base_link.
  [[nodiscard]] AckermannGeometry ackermann() const;

 private:
  RobotModel() = default;
  [[nodiscard]] const Joint* parent_joint(std::string_view link) const;
  [[noreturn]] void refuse(const std::string& reason) const;

  std::string source_;
  std::string name_;
  std::string urdf_;
  std::vector<Link> links_;
  std::vector<Joint> joints_;
};

}  // namespace coop::robot
