#pragma once
#include <array>
#include <memory>

#include "global_planner/swarm/four_way.hpp"
#include "global_planner/swarm/optimiser.hpp"

namespace coop::global_planner::swarm {

struct ViaPointConfig {
  int via_points = 4;

  void describe(config::Fields& fields);
};

/// The length of a path over via points, for swarms that search in a box: two coordinates for each
/// point, in cells. Start, points and goal are joined by runs along x and y with one corner, at the
/// corner that meets fewer blocked cells. The value is the number of steps, and as many more for
/// each blocked cell as the grid is wide and high.
class ViaPointObjective final : public Objective {
 public:
  explicit ViaPointObjective(const ViaPointConfig& config) : config_(config) {}

  /// The grid must outlive the use; start and goal are passable.
  void set(const TraversalGrid& grid, Cell start, Cell goal);

  [[nodiscard]] std::span<const double> lower() const override { return lower_; }
  [[nodiscard]] std::span<const double> upper() const override { return upper_; }
  [[nodiscard]] double operator()(std::span<const double> place) override;

  /// The cells of the path, and whether none is blocked.
  bool trace(std::span<const double> place, Track& track) const;

 private:
  [[nodiscard]] Cell point(std::span<const double> place, std::size_t i) const;
  [[nodiscard]] std::int32_t blocked_along_row(int y, int from, int to) const;
  [[nodiscard]] std::int32_t blocked_along_column(int x, int from, int to) const;
  /// Blocked cells of a leg that goes along x first, and of one that goes along y first.
  [[nodiscard]] std::array<std::int32_t, 2> blocked_on_leg(Cell from, Cell to) const;

  ViaPointConfig config_;
  const TraversalGrid* grid_ = nullptr;
  Cell start_;
  Cell goal_;
  std::vector<double> lower_;
  std::vector<double> upper_;
  std::vector<std::int32_t> in_row_;     ///< blocked cells from the row's left end to each cell
  std::vector<std::int32_t> in_column_;  ///< from the column's lower end
};

/// A swarm's optimiser as planner. Only whether a cell is passable counts, not what it costs.
/// kNoPath also where the swarm has found none.
class ViaPointPlanner final : public GridPlanner {
 public:
  ViaPointPlanner(const ViaPointConfig& config, std::unique_ptr<Optimiser> optimiser,
                  const RandomStream& random)
      : objective_(config), optimiser_(std::move(optimiser)), random_(random) {}

  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;

 private:
  ViaPointObjective objective_;
  std::unique_ptr<Optimiser> optimiser_;
  RandomStream random_;
  Track track_;
  LoopEraser eraser_;
};

}  // namespace coop::global_planner::swarm
