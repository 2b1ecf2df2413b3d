#include "sweep/node/local_engine.hpp"

#include <algorithm>
#include <memory>

#include "sweep/node/run_task.hpp"

namespace coop::sweep {

void LocalEngine::make(const Sweep& sweep, const std::vector<Run>& runs, const Watcher& watch) {
  std::vector<std::unique_ptr<RunTask>> places(static_cast<std::size_t>(jobs_));
  std::size_t next = 0;
  const auto is_busy = [&] {
    return std::ranges::any_of(places, [](const auto& task) { return task != nullptr; });
  };
  while (next < runs.size() || is_busy()) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i] && places[i]->poll()) places[i].reset();
      if (places[i] || next >= runs.size()) continue;
      places[i] =
          std::make_unique<RunTask>(sweep, runs[next++], first_domain_ + static_cast<int>(i));
    }
    // Leaving stops what runs: a task that goes asks its launcher to stop and waits for it.
    if (!watch()) return;
  }
}

}  // namespace coop::sweep
