#include "sequencer/held_karp.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace coop::sequencer {

Tour solve_exactly(const CostMatrix& costs, bool closed) {
  if (costs.size <= 1) return {};
  const std::size_t targets = costs.size - 1;
  const std::size_t sets = std::size_t{1} << targets;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  // Cheapest way from the start through a set of targets, ending at one of them.
  std::vector<double> best(sets * targets, kNever);
  std::vector<std::uint8_t> before(sets * targets, 0);
  for (std::size_t t = 0; t < targets; ++t) {
    best[(std::size_t{1} << t) * targets + t] = costs.at(0, t + 1);
  }
  for (std::size_t set = 1; set < sets; ++set) {
    for (std::size_t last = 0; last < targets; ++last) {
      const double here = best[set * targets + last];
      if ((set >> last & 1U) == 0U) continue;
      for (std::size_t next = 0; next < targets; ++next) {
        if ((set >> next & 1U) != 0U) continue;
        const std::size_t entry = (set | (std::size_t{1} << next)) * targets + next;
        const double cost = here + costs.at(last + 1, next + 1);
        // An unreachable order is kept too: each target has to stand somewhere.
        if (cost < best[entry] || (cost == kNever && before[entry] == 0)) {
          best[entry] = cost;
          before[entry] = static_cast<std::uint8_t>(last + 1);
        }
      }
    }
  }
  std::size_t last = 0;
  double cheapest = kNever;
  for (std::size_t t = 0; t < targets; ++t) {
    const double cost = best[(sets - 1) * targets + t] + (closed ? costs.at(t + 1, 0) : 0.0);
    if (cost < cheapest) {
      cheapest = cost;
      last = t;
    }
  }
  Tour tour;
  tour.cost = cheapest;
  std::size_t set = sets - 1;
  for (std::size_t step = 0; step < targets; ++step) {
    tour.order.push_back(last + 1);
    const std::size_t previous = before[set * targets + last];
    set &= ~(std::size_t{1} << last);
    last = previous == 0 ? 0 : previous - 1;
    if (previous == 0 && set != 0) {  // ties of infinite costs: any target that is left
      while ((set >> last & 1U) == 0U) ++last;
    }
  }
  std::ranges::reverse(tour.order);
  return tour;
}

}  // namespace coop::sequencer
