#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "core/search/grid_planner.hpp"

namespace coop::search {

/// One bit a cell of a padded grid, 64 cells a word: set where it is passable. Kept twice, by rows
/// and by columns, so that a run of cells is looked along in words in all four directions.
class PassableBits {
 public:
  /// Of one direction. `line` is the row (or column), `place` the cell's place in it.
  class Lines {
   public:
    void reset(int lines, int length);
    void set(int line, int place) {
      words_[word_of(line, place)] |= std::uint64_t{1} << (static_cast<unsigned>(place) % 64U);
    }
    [[nodiscard]] bool at(int line, int place) const {
      return (words_[word_of(line, place)] >> (static_cast<unsigned>(place) % 64U) & 1U) != 0;
    }
    /// Sets the places of one word, from the lowest bit on.
    void set_word(int line, int word, std::uint64_t bits) {
      words_[static_cast<std::size_t>(line * stride_ + word)] = bits;
    }

    /// A run along a line from `place`, which is not looked at itself, up to the first cell that is
    /// blocked or that opens a way to a side: one whose neighbour on a side is passable and that
    /// neighbour's predecessor blocked. The border of blocked cells ends every run.
    struct Run {
      int end;       ///< the cell that ended the run
      bool blocked;  ///< it is blocked; else it opens a way
    };
    [[nodiscard]] Run run_up(int line, int place) const;    ///< towards higher places
    [[nodiscard]] Run run_down(int line, int place) const;  ///< towards lower places

   private:
    [[nodiscard]] std::size_t word_of(int line, int place) const {
      return static_cast<std::size_t>(line * stride_ + place / 64);
    }
    std::vector<std::uint64_t> words_;
    int stride_ = 0;  ///< words a line
  };

  /// False, and the bits are of no use, where passable cells differ in cost.
  bool update(const TraversalGrid& grid);

  /// Places in the padded grid: (x + 1, y + 1) of the cell.
  [[nodiscard]] const Lines& rows() const { return rows_; }
  [[nodiscard]] const Lines& columns() const { return columns_; }

 private:
  Lines rows_;     ///< line y, place x
  Lines columns_;  ///< line x, place y
};

}  // namespace coop::search
