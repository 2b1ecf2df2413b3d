#include "sequencer/mission_state.hpp"

#include <algorithm>
#include <array>

namespace coop::sequencer {

std::string_view to_string(MissionPhase phase) {
  static constexpr std::array<std::string_view, 9> kNames{"idle",    "searching", "ordering",
                                                          "driving", "picking",   "returning",
                                                          "done",    "failed",    "paused"};
  return kNames.at(static_cast<std::size_t>(phase));
}

EggTask* MissionState::find_egg(std::string_view id, std::size_t first) {
  const auto middle = eggs.begin() + static_cast<std::ptrdiff_t>(std::min(first, eggs.size()));
  auto found = std::ranges::find(middle, eggs.end(), id, &EggTask::id);
  if (found != eggs.end()) return &*found;
  found = std::ranges::find(eggs.begin(), middle, id, &EggTask::id);
  return found == middle ? nullptr : &*found;
}

const EggTask* MissionState::find_egg(std::string_view id) const {
  const auto found = std::ranges::find(eggs, id, &EggTask::id);
  return found == eggs.end() ? nullptr : &*found;
}

int MissionState::count(EggPhase wanted) const {
  return static_cast<int>(std::ranges::count(eggs, wanted, &EggTask::phase));
}

bool MissionState::is_active() const {
  return phase != MissionPhase::kIdle && phase != MissionPhase::kDone &&
         phase != MissionPhase::kFailed;
}

}  // namespace coop::sequencer
