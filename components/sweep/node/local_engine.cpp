#include "sweep/node/local_engine.hpp"

#include <algorithm>
#include <memory>

#include "sweep/node/claim.hpp"
#include "sweep/node/run_task.hpp"

namespace coop::sweep {
namespace {

/// Where one run after the other is made.
struct Place {
  DomainClaim domain;
  std::unique_ptr<RunTask> task;
};

}  // namespace

void LocalEngine::make(const Sweep& sweep, const std::vector<Run>& runs, const Watcher& watch) {
  std::vector<Place> places;
  for (int i = 0; i < jobs_ && places.size() < runs.size(); ++i) {
    places.push_back({claim_domain(first_domain_), nullptr});
  }
  std::size_t next = 0;
  const auto is_busy = [&] {
    return std::ranges::any_of(places, [](const Place& place) { return place.task != nullptr; });
  };
  while (next < runs.size() || is_busy()) {
    for (Place& place : places) {
      if (place.task && place.task->poll()) place.task.reset();
      if (place.task || next >= runs.size()) continue;
      place.task = std::make_unique<RunTask>(sweep, runs[next++], place.domain.domain);
    }
    // Leaving stops what runs: a task that goes asks its launcher to stop and waits for it.
    if (!watch()) return;
  }
}

}  // namespace coop::sweep
