#include "demo/node/observer.hpp"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "conversions/geometry.hpp"
#include "conversions/image.hpp"
#include "conversions/navigation.hpp"
#include "conversions/time.hpp"
#include "conversions/world.hpp"
#include "coop_msgs/msg/Mission.h"

namespace coop::demo {

using coop_msgs::msg::GroundTruth;
using coop_msgs::msg::MissionStatus;
using coop_msgs::msg::SimEgg;
using coop_msgs::msg::SimHeap;
using coop_msgs::msg::World;
using nav_msgs::msg::OccupancyGrid;
using runtime::Qos;

namespace {

constexpr auto kTrackPeriod = std::chrono::milliseconds(100);
constexpr auto kPatience = std::chrono::seconds(2);

const char* mission_state_name(std::uint8_t state, bool cleans) {
  if (cleans && state == coop_msgs::msg::MissionStatus_Constants::PICKING) return "cleaning";
  static constexpr std::array kNames{"idle",      "searching", "ordering", "driving", "picking",
                                     "returning", "done",      "failed",   "paused"};
  return state < kNames.size() ? kNames.at(state) : "unknown";
}

const char* target_state_name(std::uint8_t state, bool cleans) {
  using namespace coop_msgs::msg::EggStatus_Constants;
  if (cleans && state == PICKING) return "cleaning";
  if (cleans && state == PICKED) return "cleaned";
  static constexpr std::array kNames{"seen",   "queued", "approaching", "picking",
                                     "picked", "failed", "missing"};
  return state < kNames.size() ? kNames.at(state) : "unknown";
}

}  // namespace

Observer::Observer(runtime::Node& node, const Watch& watch)
    : node_(node), watch_(watch), transforms_(node.transforms()), waiting_("map", kPatience, 200) {
  node.subscribe<World>("world", Qos::kStateLatched,
                        [this](const World& world) { receive(world); });
  node.subscribe<GroundTruth>("ground_truth", Qos::kSensorStream,
                              [this](const GroundTruth& truth) { receive(truth); });
  node.subscribe<MissionStatus>("mission_status", Qos::kStateLatched,
                                [this](const MissionStatus& status) { receive(status); });
  node.subscribe<OccupancyGrid>("map", Qos::kStateLatched, [this](const OccupancyGrid& message) {
    if (auto grid = conversions::from_msg(message)) record_.map = std::move(grid->value);
  });
  node.subscribe<OccupancyGrid>("global_costmap", Qos::kStateLatched,
                                [this](const OccupancyGrid& message) {
                                  if (auto grid = conversions::from_msg(message))
                                    record_.costmap = std::move(grid->value);
                                });
  if (watch.pictures) {
    node.subscribe<sensor_msgs::msg::Image>(
        "camera/image", Qos::kSensorStream,
        [this](const sensor_msgs::msg::Image& picture) { receive(picture); });
  }
  node.every(kTrackPeriod, [this] { match_track(); });
}

void Observer::receive(const World& world) {
  // The map's origin is where the robot stood when its mapping began: the start pose of the world.
  const auto start = conversions::pose3_from_msg(world.robot_start());
  if (!start || world_in_map_) return;
  world_in_map_ = watch_.map_is_world ? Pose2{} : to_pose2(*start).inverse();
  record_.targets_in_world = static_cast<int>(world.eggs().size() + world.heaps().size());
}

void Observer::receive(const GroundTruth& truth) {
  record_.collisions = truth.collision_count();
  record_.animal_collisions = truth.animal_collision_count();
  const auto collected =
      std::ranges::count(truth.eggs(), coop_msgs::msg::SimEgg_Constants::COLLECTED,
                         [](const SimEgg& egg) { return egg.state(); });
  const auto cleaned = std::ranges::count(truth.heaps(), coop_msgs::msg::SimHeap_Constants::CLEANED,
                                          [](const SimHeap& heap) { return heap.state(); });
  record_.targets_taken = static_cast<int>(collected + cleaned);
  const auto stamp = conversions::from_msg(truth.header().stamp());
  const auto pose = conversions::pose3_from_msg(truth.robot());
  if (!stamp || !pose || *stamp < last_track_ + kTrackPeriod) return;
  last_track_ = *stamp;
  waiting_.push({*stamp, to_pose2(*pose)}, "base_link", *stamp);
  note_pen(truth);
}

void Observer::note_pen(const GroundTruth& message) {
  const auto truth = conversions::from_msg(message);
  if (!truth || !world_in_map_) return;
  record_.heaps = truth->heaps;
  for (world::Heap& heap : record_.heaps) heap.position = *world_in_map_ * heap.position;
  record_.animal_tracks.resize(truth->animals.size());
  record_.animal_radii.clear();
  for (std::size_t i = 0; i < truth->animals.size(); ++i) {
    record_.animal_tracks[i].push_back(*world_in_map_ * truth->animals[i].position);
    record_.animal_radii.push_back(truth->animals[i].radius);
  }
}

void Observer::receive(const sensor_msgs::msg::Image& message) {
  auto picture = conversions::from_msg(message);
  if (!picture) return;
  cv::Mat view;
  cv::cvtColor(picture->pixels, view, cv::COLOR_RGB2BGR);
  if (record_.first_view.empty()) record_.first_view = view;
  record_.last_view = view;
}

void Observer::match_track() {
  if (!world_in_map_) return;
  waiting_.process(transforms_, node_.now(), [this](const Truth& truth, const Pose3& base_in_map) {
    record_.track.push_back(
        {truth.stamp, *world_in_map_ * truth.robot_in_world, to_pose2(base_in_map)});
  });
}

void Observer::receive(const MissionStatus& status) {
  const bool cleans = status.kind() == coop_msgs::msg::Mission_Constants::CLEAN;
  record_.mission_state = mission_state_name(status.state(), cleans);
  record_.mission_detail = status.detail();
  record_.order = status.order();
  record_.tour_cost = status.tour_cost();
  record_.targets.clear();
  for (const auto& egg : status.eggs()) {
    record_.targets.push_back({egg.egg_id(),
                               {egg.position().x(), egg.position().y()},
                               target_state_name(egg.state(), cleans),
                               egg.attempts(),
                               egg.reason()});
  }
}

std::string Observer::progress() const {
  if (record_.mission_state.empty()) return "starting";
  std::string line = record_.mission_state;
  if (!record_.mission_detail.empty()) line += ": " + record_.mission_detail;
  if (record_.targets_in_world > 0 && !record_.targets.empty()) {
    const bool cleans = !record_.heaps.empty();
    line += fmt::format(" [{} seen {}, {} {} of {}]", cleans ? "heaps" : "eggs",
                        record_.targets.size(), cleans ? "cleaned" : "collected",
                        record_.targets_taken, record_.targets_in_world);
  }
  return line;
}

}  // namespace coop::demo
