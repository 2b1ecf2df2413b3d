#include "core/search/passable_bits.hpp"

#include <algorithm>
#include <array>

namespace coop::search {

void PassableBits::Lines::reset(int lines, int length) {
  stride_ = (length + 63) / 64;
  words_.assign(static_cast<std::size_t>(lines) * static_cast<std::size_t>(stride_), 0);
}

PassableBits::Lines::Run PassableBits::Lines::run_up(int line, int place) const {
  const std::uint64_t* here = &words_[word_of(line, place)];
  const std::uint64_t* left = here - stride_;
  const std::uint64_t* right = here + stride_;
  const unsigned bit = static_cast<unsigned>(place) % 64U;
  int base = place - static_cast<int>(bit);
  // Bits above the place; shifted in two steps, for 64 at once is undefined.
  std::uint64_t wanted = ~std::uint64_t{0} << bit << 1U;
  std::uint64_t left_before = 0;
  std::uint64_t right_before = 0;
  if (bit == 63) {  // the next word's lowest cell has its predecessors in this one
    left_before = *left >> 63U;
    right_before = *right >> 63U;
    ++here, ++left, ++right;
    base += 64;
    wanted = ~std::uint64_t{0};
  }
  for (;; ++here, ++left, ++right, base += 64, wanted = ~std::uint64_t{0}) {
    const std::uint64_t opens_left = *left & ~(*left << 1U | left_before);
    const std::uint64_t opens_right = *right & ~(*right << 1U | right_before);
    const std::uint64_t ends = (opens_left | opens_right | ~*here) & wanted;
    if (ends != 0) {
      const int end = std::countr_zero(ends);
      return {base + end, (*here >> static_cast<unsigned>(end) & 1U) == 0};
    }
    left_before = *left >> 63U;
    right_before = *right >> 63U;
  }
}

PassableBits::Lines::Run PassableBits::Lines::run_down(int line, int place) const {
  const std::uint64_t* here = &words_[word_of(line, place)];
  const std::uint64_t* left = here - stride_;
  const std::uint64_t* right = here + stride_;
  const unsigned bit = static_cast<unsigned>(place) % 64U;
  int base = place - static_cast<int>(bit);
  std::uint64_t wanted = (std::uint64_t{1} << bit) - 1;
  std::uint64_t left_before = 0;
  std::uint64_t right_before = 0;
  if (bit == 0) {
    left_before = *left << 63U;
    right_before = *right << 63U;
    --here, --left, --right;
    base -= 64;
    wanted = ~std::uint64_t{0};
  }
  for (;; --here, --left, --right, base -= 64, wanted = ~std::uint64_t{0}) {
    const std::uint64_t opens_left = *left & ~(*left >> 1U | left_before);
    const std::uint64_t opens_right = *right & ~(*right >> 1U | right_before);
    const std::uint64_t ends = (opens_left | opens_right | ~*here) & wanted;
    if (ends != 0) {
      const int end = 63 - std::countl_zero(ends);
      return {base + end, (*here >> static_cast<unsigned>(end) & 1U) == 0};
    }
    left_before = *left << 63U;
    right_before = *right << 63U;
  }
}

bool PassableBits::update(const TraversalGrid& grid) {
  const int width = grid.stride();
  const int height = grid.geometry().height + 2;
  rows_.reset(height, width);
  columns_.reset(width, height);
  float common = TraversalGrid::kBlocked;
  std::array<bool, 256> passable{};
  for (std::size_t cost = 0; cost < 256; ++cost) {
    passable[cost] = grid.factors()[cost] < TraversalGrid::kBlocked;
  }
  const Cost* cells = grid.cells().data();
  for (int y = 0; y < height; ++y, cells += width) {
    for (int first = 0; first < width; first += 64) {
      const int count = std::min(64, width - first);
      std::uint64_t bits = 0;
      for (int i = 0; i < count; ++i) {
        const Cost cost = cells[first + i];
        if (!passable[cost]) continue;
        const float factor = grid.factors()[cost];
        if (common == TraversalGrid::kBlocked) common = factor;
        if (factor != common) return false;
        bits |= std::uint64_t{1} << static_cast<unsigned>(i);
        columns_.set(first + i, y);
      }
      rows_.set_word(y, first / 64, bits);
    }
  }
  return true;
}

}  // namespace coop::search
