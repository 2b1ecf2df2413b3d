#pragma once
#include "demo/record.hpp"

namespace coop::demo {

struct ErrorFigures {
  double mean = 0.0;
  double p95 = 0.0;
  double max = 0.0;
};

/// The numbers of a run.
struct Figures {
  double duration = 0.0;         ///< s, first to last track point
  double distance_driven = 0.0;  ///< m, along the true track
  double mean_speed = 0.0;       ///< m/s
  ErrorFigures position_error;   ///< m, estimate against truth
  ErrorFigures heading_error;    ///< rad
  int targets_done = 0;
  int targets_failed = 0;
};

[[nodiscard]] Figures compute_figures(const Record& record);

/// Five of five picked, counted by mission and simulator alike, and no collision.
[[nodiscard]] bool is_success(const Record& record);

/// A pen without manure, by mission and simulator alike, and no collision.
[[nodiscard]] bool is_clean(const Record& record);

}  // namespace coop::demo
