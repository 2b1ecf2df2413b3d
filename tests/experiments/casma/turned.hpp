#pragma once
#include <memory>
#include <utility>

#include "core/search/grid_planner.hpp"

namespace coop::casma {

/// A planner that is shown the pen turned by 180 degrees. Whoever treats all directions alike plans
/// as well as before.
class Turned final : public GridPlanner {
 public:
  explicit Turned(std::unique_ptr<GridPlanner> planner) : planner_(std::move(planner)) {}

  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;

 private:
  std::unique_ptr<GridPlanner> planner_;
};

}  // namespace coop::casma
