#pragma once
#include "sweep/node/engine.hpp"

namespace coop::sweep {

/// Sees to it that a folder holds results of one set of inputs: the first call leaves inputs.txt
/// there; a later one with other inputs is refused (config::Error, one line) where there are
/// results, or where it is a task of a call whose inputs they no longer are.
void settle_inputs(const Sweep& sweep, bool is_task);

}  // namespace coop::sweep
