#include "sequencer/mission_rules.hpp"

#include <array>

namespace coop::sequencer {

const MissionRules& Mission::rules() const {
  static const MissionRules kCollect{
      .target = "egg",
      .done = "picked",
      .observe = &Mission::note_late_pick,
      .knows_enough = &Mission::knows_expected_eggs,
      .after_search = &Mission::order_eggs,
      .is_put_off = [](const EggTask& egg) { return egg.unseen > 0; },
      .waits = &Mission::waits_never,
      .on_the_way = &Mission::looks_in_vain,
      .at_target = &Mission::step_arrival,
      .nothing_left = &Mission::end_or_search_again,
      .at_home = &Mission::finish,
  };
  static const MissionRules kSurvey{
      .target = "",
      .done = "",
      .observe = &Mission::look_on,
      .knows_enough = &Mission::knows_nothing,
      .after_search = &Mission::end_survey,
      .is_put_off = nullptr,
      .waits = nullptr,
      .on_the_way = nullptr,
      .at_target = nullptr,
      .nothing_left = nullptr,
      .at_home = &Mission::finish,
  };
  static const MissionRules kClean{
      .target = "heap",
      .done = "cleaned",
      .observe = &Mission::note_swept,
      .knows_enough = &Mission::knows_nothing,
      .after_search = &Mission::order_heaps,
      .is_put_off = [](const EggTask& heap) { return heap.attempts > 0; },
      .waits = &Mission::waits_for_pigs,
      .on_the_way = &Mission::drives_on,
      .at_target = &Mission::step_beside_heap,
      .nothing_left = &Mission::go_home_and_look,
      .at_home = &Mission::look_back,
  };
  static const std::array<const MissionRules*, 3> kRules{&kCollect, &kSurvey, &kClean};
  return *kRules.at(static_cast<std::size_t>(state_.kind));
}

void Mission::look_on(const MissionSnapshot& /*snapshot*/) {}

bool Mission::drives_on(const MissionSnapshot& /*snapshot*/, EggTask& /*target*/) {
  return false;
}

bool Mission::waits_never(const std::vector<const EggTask*>& /*put_off*/, Time /*now*/) {
  return false;
}

bool Mission::knows_nothing() const {
  return false;
}

void Mission::end_survey(const MissionSnapshot& /*snapshot*/) {
  finish();
}

}  // namespace coop::sequencer
