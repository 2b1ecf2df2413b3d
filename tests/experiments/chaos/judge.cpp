#include "experiments/chaos/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace coop::chaos {
namespace {

constexpr double kMoving = 0.05;  ///< m/s
/// Speed is the way gone in so long before and after, s: wheels that slip at random make that of a
/// single tick uncertain by 0.02 m/s.
constexpr double kWindow = 0.06;
constexpr double kNoise = 0.03;  ///< m/s: what is left of it, three times over

/// Two eggs of the mission nearer than this are one.
constexpr double kSameEgg = 0.10;  ///< m

/// Mean speed around motion[i], of what lies before `found`; none where nothing else does.
std::optional<double> speed_at(const std::vector<Motion>& motion, std::size_t i, double found) {
  const double time = motion[i].time;
  std::size_t first = i;
  std::size_t last = i;
  while (first > 0 && motion[first - 1].time >= time - kWindow) --first;
  while (last + 1 < motion.size() && motion[last + 1].time <= std::min(time + kWindow, found))
    ++last;
  if (motion[last].time <= motion[first].time) return std::nullopt;
  return (motion[last].distance - motion[first].distance) /
         (motion[last].time - motion[first].time);
}

}  // namespace

Stopping judge_stopping(const std::vector<Motion>& motion, double lost, double found,
                        double clock_error) {
  Stopping result;
  double at_loss = 0.0;
  double limit = 0.0;  // the slowest it has been since it must brake
  double begun = lost;
  double slowest = 1e9;
  const double due = lost + kReaction + clock_error;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double time = motion[i].time;
    if (time > found) break;
    const auto speed = speed_at(motion, i, found);
    if (!speed) continue;
    if (time <= lost) at_loss = *speed;
    if (time < lost) continue;
    if (*speed > slowest + kNoise) begun = time;
    if (*speed > slowest + kNoise || *speed < slowest) slowest = *speed;
    if (time <= due) {
      limit = *speed;
      continue;
    }
    const double since = time - due - kDriveDelay;
    const double slowed = std::max(0.0, limit - kBraking * std::max(0.0, since));
    if (*speed > slowed + kNoise) result.is_safe = false;
  }
  result.was_moving = at_loss > kMoving;
  result.begun_after = begun - lost;
  return result;
}

std::vector<std::string> judge_eggs(const coop_msgs::msg::MissionStatus& mission,
                                    const coop_msgs::msg::GroundTruth& truth) {
  namespace Egg = coop_msgs::msg::EggStatus_Constants;
  namespace TrueEgg = coop_msgs::msg::SimEgg_Constants;
  std::vector<std::string> wrong;
  const auto collected = std::ranges::count(truth.eggs(), TrueEgg::COLLECTED,
                                            [](const auto& egg) { return egg.state(); });
  const auto broken = std::ranges::count(truth.eggs(), TrueEgg::BROKEN,
                                         [](const auto& egg) { return egg.state(); });
  const auto picked =
      std::ranges::count(mission.eggs(), Egg::PICKED, [](const auto& egg) { return egg.state(); });
  if (picked != collected) {
    wrong.push_back(
        fmt::format("the mission counts {} eggs, in the basket are {}", picked, collected));
  }
  if (broken > 0) wrong.push_back(fmt::format("{} eggs broken", broken));
  std::set<std::string> ids;
  for (const auto& egg : mission.eggs()) {
    if (!ids.insert(egg.egg_id()).second) wrong.push_back("egg " + egg.egg_id() + " twice");
  }
  const auto& eggs = mission.eggs();
  for (std::size_t i = 0; i < eggs.size(); ++i) {
    for (std::size_t j = i + 1; j < eggs.size(); ++j) {
      if (eggs[i].state() != Egg::PICKED || eggs[j].state() != Egg::PICKED) continue;
      const double apart = std::hypot(eggs[i].position().x() - eggs[j].position().x(),
                                      eggs[i].position().y() - eggs[j].position().y());
      if (apart < kSameEgg) wrong.push_back("one egg picked as two: " + eggs[i].egg_id());
    }
  }
  return wrong;
}

}  // namespace coop::chaos
