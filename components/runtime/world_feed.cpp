#include "runtime/world_feed.hpp"

#include <coop_msgs/msg/GroundTruth.h>
#include <coop_msgs/msg/World.h>

#include <utility>

#include "conversions/world.hpp"

namespace coop::runtime {
namespace {

/// Ground truth comes at 50 Hz; without it for this long there is nothing to speak of.
constexpr Duration kTruthTimeout = std::chrono::milliseconds(500);
constexpr Duration kComplaintPeriod = std::chrono::seconds(5);

}  // namespace

WorldFeed::WorldFeed(Node& node, double rate, Handlers handlers)
    : node_(node), period_(seconds(1.0 / rate)), handlers_(std::move(handlers)) {
  node.subscribe<coop_msgs::msg::World>(
      "world", Qos::kStateLatched, [this](const coop_msgs::msg::World& message) {
        if (const auto world = conversions::from_msg(message)) {
          has_world_ = true;
          handlers_.world(*world);
        } else {
          node_.log().warning("refused a world: {}", world.error());
        }
      });
  node.subscribe<coop_msgs::msg::GroundTruth>(
      "ground_truth", Qos::kSensorStream,
      [this](const coop_msgs::msg::GroundTruth& message) {
        if (const auto truth = conversions::from_msg(message)) {
          receive(*truth);
        } else if (node_.log().is_due("truth", kComplaintPeriod)) {
          node_.log().warning("refused a ground truth: {}", truth.error());
        }
      },
      Attention::kPatient);
  // Between its turns the truth only needs to be there.
  node.every_aligned(period_, [] {});
  node.every(kTruthTimeout / 5, [this] { check_freshness(); });
}

void WorldFeed::receive(const world::GroundTruth& truth) {
  last_truth_ = truth.stamp;
  if (!has_world_) return;
  const std::int64_t turn = to_nanoseconds(truth.stamp) / period_.count();
  const bool is_first = last_turn_ < 0;  // somewhere within a period: wait for its end
  if (turn == std::exchange(last_turn_, turn) || is_first) return;
  handlers_.measure(truth);
}

void WorldFeed::check_freshness() {
  if (!has_world_) {
    node_.set_degraded("no world yet");
  } else if (last_truth_ == Time{} || node_.now() - last_truth_ > kTruthTimeout) {
    node_.set_degraded("no ground truth");
  } else {
    node_.set_ready();
  }
}

}  // namespace coop::runtime
