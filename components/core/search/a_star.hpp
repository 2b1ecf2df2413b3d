#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/search/grid_planner.hpp"
#include "core/search/tiles.hpp"

namespace coop {

/// A* (Hart, Nilsson, Raphael 1968) with the octile distance, which underestimates no path, since
/// no step costs less than its length.
///
/// The open list is an array of buckets a quarter of a cell length wide over cost + estimate. Cells
/// within a bucket are taken in any order, newest first, so a cell may be expanded again when its
/// cost falls; the search ends when no cell left can be on a cheaper path, so the result is optimal
/// up to the rounding of floats.
///
/// Where a cell and its eight neighbours all cost the same, only the steps are tried that no path
/// around the cell makes as cheaply (the neighbour pruning of Harabor and Grastien 2011, for grids
/// without cut corners, applied locally): most of free ground needs one test a cell.
class AStar final : public GridPlanner {
 public:
  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;
  /// Expansions of the last query.
  [[nodiscard]] std::size_t expansions() const { return expansions_; }

 private:
  void prepare(const TraversalGrid& grid);
  void search(const std::array<float, 256>& factors, Cell start, Cell goal);
  void expand(const std::array<float, 256>& factors, std::uint32_t index, std::uint32_t arrival);
  void relax(std::uint32_t neighbour, float cost, Cell at, std::uint32_t step);
  [[nodiscard]] std::uint32_t slot_of(float cost, Cell at) const;
  [[nodiscard]] GridPath path(const TraversalGrid& grid, Cell start, Cell goal) const;

  search::Tiles tiles_;
  std::vector<float> cost_;            ///< from the start, cells of free ground, in tiles
  std::vector<std::uint8_t> arrival_;  ///< by which step the cheapest path enters; kWaiting
  std::vector<std::uint8_t> touched_;  ///< 1: the tile holds costs of the last query
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::uint32_t bucket_mask_ = 0;
  std::uint32_t current_ = 0;
  std::size_t waiting_ = 0;
  std::size_t expansions_ = 0;
  Cell goal_;
};

}  // namespace coop
