#pragma once
#include <vector>

#include "capture/traffic/lockstep_script.hpp"
#include "capture/traffic/play_list.hpp"

namespace coop::capture {

/// What a capture holds of the lockstep's own talk; empty where it was none.
[[nodiscard]] std::vector<RecordedRoster> recorded_rosters(PlayList& list);
[[nodiscard]] std::vector<RecordedOrder> recorded_orders(PlayList& list);

}  // namespace coop::capture
