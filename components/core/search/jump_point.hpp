#pragma once
#include <cstdint>
#include <vector>

#include "core/search/grid_planner.hpp"
#include "core/search/passable_bits.hpp"

namespace coop {

/// Jump point search (Harabor and Grastien 2011; 2014: blocks of cells and pruning of intermediate
/// points), for grids on which corners are not cut. Optimal on grids whose passable cells all cost
/// the same, and only there: on others it says kCostsDiffer and does not search (inflation without
/// weights, `restricted_weight: 0`, gives such a grid).
///
/// Without cut corners no diagonal step has a forced neighbour; a straight one has where the cell
/// beside its origin is blocked and the one beside its end is not. Runs along rows and columns look
/// at 64 cells at a time. Diagonal runs are walked cell by cell; what their straight runs find is
/// reached from the run's origin at once, so points in between never enter the open list.
///
/// The bits of a grid are made once and kept until its revision changes.
class JumpPoint final : public GridPlanner {
 public:
  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;
  /// Expansions of the last query.
  [[nodiscard]] std::size_t expansions() const { return expansions_; }

 private:
  /// Cells here are those of the padded grid.
  struct Node {
    double cost;           ///< from the start, cells
    std::uint32_t cell;    ///< padded index
    std::uint32_t parent;  ///< number of the node it was reached from
    std::int8_t dx, dy;    ///< the straight step it was reached by; 0, 0: start or goal
    bool closed;
  };
  struct Entry {
    double estimate;  ///< cost + estimate to the goal
    double cost;
    std::uint32_t node;
  };
  struct Origin {
    Cell at;
    std::uint32_t node;
    double cost;
  };

  bool prepare(const TraversalGrid& grid);
  bool search(Cell start, Cell goal);
  void expand(const Origin& from, int dx, int dy);
  void expand_all(const Origin& from);
  /// Looks along a straight line; `at` lies `cost` from the start on a path through `from`.
  void jump_straight(const Origin& from, Cell at, double cost, int dx, int dy);
  void jump_diagonal(const Origin& from, int dx, int dy);
  void reach(const Origin& from, Cell at, double cost, int dx, int dy);
  [[nodiscard]] double estimate(Cell at) const;
  [[nodiscard]] bool passable(int x, int y) const { return bits_.rows().at(y, x); }
  [[nodiscard]] std::uint32_t index_of(Cell at) const {
    return static_cast<std::uint32_t>(at.y * stride_ + at.x);
  }
  [[nodiscard]] GridPath path(const TraversalGrid& grid, Cell goal) const;

  search::PassableBits bits_;
  std::uint64_t revision_ = 0;
  bool costs_differ_ = false;
  int stride_ = 0;
  std::vector<Node> nodes_;            ///< reached in this query; they stay in the nearest cache
  std::vector<std::uint32_t> number_;  ///< by padded index: its node's number + 1, 0: none
  std::vector<Entry> open_;            ///< binary heap
  Cell goal_;
  std::uint32_t goal_index_ = 0;
  std::size_t expansions_ = 0;
};

}  // namespace coop
