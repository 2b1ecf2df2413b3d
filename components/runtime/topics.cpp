#include "runtime/topics.hpp"

#include <algorithm>
#include <array>

namespace coop::runtime {
namespace {

constexpr auto kStream = Qos::kSensorStream;
constexpr auto kLatched = Qos::kStateLatched;
constexpr auto kEvent = Qos::kEvent;

// Whatever drives the wheels: the driver of the real base, or the simulator in its place.
constexpr std::string_view kBase = "chassis_driver, simulator";
// The program that leads time in lockstep.
constexpr std::string_view kMaster = "master of time";

/// What every system has: time, health, frames, captures.
constexpr auto kSystemTopics = std::to_array<TopicInfo>({
    {"clock", "rosgraph_msgs/Clock", kEvent, 100, "chassis_driver, play, simulator", "all",
     "simulated or replayed time; components follow it under --sim-time"},
    {"component_status", "coop_msgs/ComponentStatus", Qos::kHeartbeat, 2, "all", "launcher",
     "health and heartbeat of each program"},
    {"emergency_stop", "coop_msgs/EmergencyStop", kLatched, 0, "launcher, person",
     "arm_driver, chassis_driver, dwa, simulator", "in force while any source has it engaged"},
    {"lockstep_done", "coop_msgs/LockstepDone", kEvent, 0, "all", kMaster,
     "lockstep: ready for the round, done with the tick, or leaving"},
    {"lockstep_join", "coop_msgs/LockstepJoin", kLatched, 0, "all", kMaster,
     "lockstep: asks to be taken in"},
    {"lockstep_roster", "coop_msgs/LockstepRoster", kLatched, 0, kMaster, "all",
     "lockstep: who takes part from which tick on"},
    {"lockstep_tick", "coop_msgs/LockstepTick", kEvent, 0, kMaster, "all",
     "lockstep: run this tick; each component has a topic of its own, lockstep_tick/NAME"},
    {"robot_description", "std_msgs/String", kLatched, 0, "arm_driver", "person", "the URDF"},
    {"save_capture", "coop_msgs/SaveCapture", kEvent, 0, "person", "record",
     "write what the ring of a recorder holds to disk"},
    {"save_capture_result", "coop_msgs/SaveCaptureResult", kEvent, 0, "record", "person",
     "where a capture was written"},
    {"tf", "tf2_msgs/TFMessage", kEvent, 0, "amcl, arm_driver, chassis_driver, simulator, slam",
     "all", "moving transforms"},
    {"tf_static", "tf2_msgs/TFMessage", kLatched, 0,
     "arm_driver, camera_driver, lidar_driver, simulator", "all", "fixed transforms"},
});

/// What sensors and the world tell.
constexpr auto kSensorTopics = std::to_array<TopicInfo>({
    {"animals", "vision_msgs/Detection3DArray", kEvent, 5, "camera_driver", "dwa, global_planner",
     "animals that an overhead camera found in one picture, in map; an empty list says none"},
    {"camera/camera_info", "sensor_msgs/CameraInfo", kStream, 5, "camera_driver",
     "sequencer, person", "calibration of the picture of the same stamp"},
    {"camera/depth", "sensor_msgs/Image", kStream, 5, "camera_driver", "person",
     "16UC1, mm along the optical axis, 0 where unknown"},
    {"camera/image", "sensor_msgs/Image", kStream, 5, "camera_driver", "person", "colour"},
    {"eggs", "vision_msgs/Detection3DArray", kEvent, 5, "camera_driver", "sequencer",
     "eggs found in one picture, in the camera's optical frame; an empty list says none"},
    {"gripper", "coop_msgs/GripperState", kStream, 50, "arm_driver", "simulator",
     "suction, vacuum and the pose of the cup"},
    {"ground_truth", "coop_msgs/GroundTruth", kStream, 50, "simulator",
     "arm_driver, camera_driver, lidar_driver, referee", "true state of the simulated world"},
    {"imu", "sensor_msgs/Imu", kStream, 100, "simulator", "person", "rates and accelerations"},
    {"joint_states", "sensor_msgs/JointState", kStream, 50, "arm_driver", "person",
     "joints of the arm"},
    {"manure", "vision_msgs/Detection3DArray", kEvent, 5, "camera_driver", "sequencer",
     "heaps of manure in one picture of an overhead camera, in map; an empty list says none"},
    {"odom", "nav_msgs/Odometry", kStream, 50, kBase, "amcl, dwa, launcher, slam",
     "base_link in odom, and its velocity"},
    {"scan", "sensor_msgs/LaserScan", kStream, 10, "lidar_driver",
     "amcl, dwa, global_planner, slam", "one sweep of the laser"},
    {"world", "coop_msgs/World", kLatched, 0, "simulator", "camera_driver, lidar_driver, referee",
     "the simulated world at the start"},
});

/// Where the robot is and where it goes.
constexpr auto kNavigationTopics = std::to_array<TopicInfo>({
    {"amcl_pose", "geometry_msgs/PoseWithCovarianceStamped", kLatched, 0, "amcl", "person",
     "pose in map with covariance, at every update of the filter"},
    {"cmd_vel", "geometry_msgs/TwistStamped", Qos::kCommand, 20, "dwa", kBase,
     "velocity wanted of base_link; the base stops when it stops coming"},
    {"dwa_candidates", "coop_msgs/DwaCandidates", kStream, 0, "dwa", "person",
     "trajectories weighed in one control step"},
    {"global_costmap", "nav_msgs/OccupancyGrid", kLatched, 0, "global_planner", "sequencer, person",
     "costs of the planner's grid in percent"},
    {"global_localization", "coop_msgs/GlobalLocalization", kEvent, 0, "person", "amcl",
     "localise from scratch"},
    {"goal_pose", "geometry_msgs/PoseStamped", kEvent, 0, "person, sequencer",
     "global_planner, referee",
     "where base_link is to go, named by its stamp; no frame: taken back"},
    {"initialpose", "geometry_msgs/PoseWithCovarianceStamped", kEvent, 0, "person", "amcl",
     "where the robot stands, told by a person"},
    {"local_costmap", "nav_msgs/OccupancyGrid", kStream, 0, "dwa", "person",
     "costs around the robot in percent"},
    {"local_plan", "nav_msgs/Path", kStream, 0, "dwa", "person", "the trajectory chosen"},
    {"map", "nav_msgs/OccupancyGrid", kLatched, 0, "amcl, slam", "dwa, global_planner, person",
     "the map being made, or the map served"},
    {"navigation_status", "coop_msgs/NavigationStatus", kLatched, 0, "dwa, global_planner",
     "global_planner, referee, sequencer", "what each navigator does about its goal"},
    {"particle_cloud", "geometry_msgs/PoseArray", kStream, 0, "amcl", "person",
     "particles of the filter"},
    {"plan", "nav_msgs/Path", kLatched, 0, "global_planner", "dwa", "path to the goal, in map"},
    {"save_map", "coop_msgs/SaveMap", kEvent, 0, "person", "slam", "write the map to disk"},
    {"save_map_result", "coop_msgs/SaveMapResult", kEvent, 0, "slam", "person",
     "where the map was written"},
});

/// What the robot is to do.
constexpr auto kMissionTopics = std::to_array<TopicInfo>({
    {"mission", "coop_msgs/Mission", kLatched, 0, "person", "sequencer",
     "a mission, or a command to the one that runs"},
    {"mission_status", "coop_msgs/MissionStatus", kLatched, 0, "sequencer",
     "dwa, global_planner, launcher, person, referee", "state of the mission and of every egg"},
    {"pick", "coop_msgs/Pick", kEvent, 0, "sequencer", "arm_driver", "pick this egg"},
    {"pick_result", "coop_msgs/PickResult", kEvent, 0, "arm_driver", "sequencer",
     "how a pick ended"},
});

constexpr auto kTopics = [] {
  std::array<TopicInfo, kSystemTopics.size() + kSensorTopics.size() + kNavigationTopics.size() +
                            kMissionTopics.size()>
      all{};
  auto end = std::ranges::copy(kSystemTopics, all.begin()).out;
  end = std::ranges::copy(kSensorTopics, end).out;
  end = std::ranges::copy(kNavigationTopics, end).out;
  std::ranges::copy(kMissionTopics, end);
  std::ranges::sort(all, {}, &TopicInfo::name);
  return all;
}();

}  // namespace

std::span<const TopicInfo> all_topics() {
  return kTopics;
}

const TopicInfo* find_topic(std::string_view name) {
  const auto found = std::ranges::lower_bound(kTopics, name, {}, &TopicInfo::name);
  return found != kTopics.end() && found->name == name ? &*found : nullptr;
}

std::string dds_type_name(std::string_view type) {
  const auto slash = type.find('/');
  return std::string(type.substr(0, slash)) +
         "::msg::dds_::" + std::string(type.substr(slash + 1)) + "_";
}

bool lists(std::string_view programs, std::string_view program) {
  while (!programs.empty()) {
    const auto comma = programs.find(", ");
    const auto first = programs.substr(0, comma);
    if (first == program || first == "all") return true;
    if (comma == std::string_view::npos) break;
    programs.remove_prefix(comma + 2);
  }
  return false;
}

}  // namespace coop::runtime
