#pragma once
#include <string>

#include "experiments/navigation/closed_loop.hpp"

namespace coop::test {

/// The run as a PNG: house, first and last plan, track driven (blue forwards, magenta backwards),
/// footprints, egg.
void draw_run(const std::string& file, const ClosedLoopConfig& config, const OccupancyGrid& house,
              const EggTask& task, const RunResult& result);

}  // namespace coop::test
