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
/// without cut corners, applied locally). A straight step into such a cell leads on straight and
/// nowhere else, so up to eight of them are made at once, without the open list; what that
/// costs a cell too much is put right when a cheaper path comes. A cell reached within the bucket
/// that is being emptied is expanded next, without the open list as well. Elsewhere the three
/// steps that turn back are left out: the cell before makes them more cheaply.
class AStar final : public GridPlanner {
 public:
  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;
  /// Expansions of the last query.
  [[nodiscard]] std::size_t expansions() const { return expansions_; }

 private:
  static constexpr std::uint32_t kNowhere = ~std::uint32_t{0};

  void prepare(const TraversalGrid& grid);
  void search(const std::array<float, 256>& factors, Cell start, Cell goal);
  void empty_bucket(const std::array<float, 256>& factors);
  void expand(const std::array<float, 256>& factors, std::uint32_t index);
  void reach_along(float factor, std::uint32_t index, float cost, std::uint32_t step);
  void reach(std::uint32_t index, float cost, std::uint32_t step);
  [[nodiscard]] std::uint32_t slot_of(float estimate) const;
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
  std::uint32_t last_ = 0;         ///< the goal's index
  std::uint32_t next_ = kNowhere;  ///< reached within the bucket being emptied, not in it
};

}  // namespace coop
