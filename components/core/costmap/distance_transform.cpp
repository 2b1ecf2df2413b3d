#include "core/costmap/distance_transform.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace coop {

namespace {

constexpr int kBlock = 16;        // cells measured together
constexpr int kBlocksPay = 48;    // the largest cap for which whole rows are faster in blocks
constexpr int kRoundsAtOnce = 4;  // distances tried between two looks at what is left to gain

constexpr int kFarthest = (DistanceTransform::kSmallCap + kRoundsAtOnce - 1) / kRoundsAtOnce *
                          kRoundsAtOnce;  // the largest distance ever tried
static_assert(kFarthest * kFarthest + DistanceTransform::kSmallCap * DistanceTransform::kSmallCap <=
              std::numeric_limits<std::int16_t>::max());

/// The distance in a column from what the neighbouring row says, in cells.
std::uint16_t one_more(std::uint16_t neighbour, std::uint16_t cap) {
  return static_cast<std::uint16_t>(neighbour < cap ? neighbour + 1 : cap);
}

/// Eight values side by side: the compiler's own vectors, on every processor. It does not find the
/// 16-bit minimum in plain loops, which makes them five times as long (bench core_costmap).
using Eight = std::int16_t __attribute__((vector_size(16)));

Eight load(const std::int16_t* from) {
  Eight values;
  std::memcpy(&values, from, sizeof values);
  return values;
}

Eight lesser(Eight a, Eight b) {
  return a < b ? a : b;
}

std::int16_t largest_of(Eight a, Eight b) {
  const Eight larger = a > b ? a : b;
  std::int16_t largest = larger[0];
  for (std::size_t i = 1; i < 8; ++i) largest = std::max(largest, larger[i]);
  return largest;
}

/// One block of a row under a small cap: the least of d * d + squares[i +- d].
void measure_block(const std::int16_t* squares, std::int16_t* best) {
  Eight low = load(squares);
  Eight high = load(squares + 8);
  std::int16_t largest = largest_of(low, high);
  for (int d = 1; d * d < largest;) {
    for (const int until = d + kRoundsAtOnce; d < until; ++d) {
      const Eight along = static_cast<std::int16_t>(d * d) - Eight{};
      low = lesser(low, lesser(load(squares - d), load(squares + d)) + along);
      high = lesser(high, lesser(load(squares + 8 - d), load(squares + 8 + d)) + along);
    }
    largest = largest_of(low, high);
  }
  std::memcpy(best, &low, sizeof low);
  std::memcpy(best + 8, &high, sizeof high);
}

}  // namespace

void DistanceTransform::run(std::span<const std::uint8_t> sources, int width, int height,
                            std::span<std::int32_t> squared_cells, int cap) {
  const auto w = static_cast<std::size_t>(width);
  width_ = width;
  height_ = height;
  cap_ = std::clamp(cap, 1, kNoCap);
  column_distance_.resize(w * static_cast<std::size_t>(height));
  measure_columns(sources);
  const bool in_blocks = cap_ <= kBlocksPay;
  if (!in_blocks) {
    envelope_.resize(w);
    for (std::size_t d = half_inverse_.size(); d <= w; ++d) {
      half_inverse_.push_back(d == 0 ? 0.0 : 0.5 / static_cast<double>(d));
    }
  }
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    if (!in_blocks) {
      measure_row(&column_distance_[y * w], &squared_cells[y * w]);
    } else if (width > 0) {
      measure_run(&column_distance_[y * w], &squared_cells[y * w], 0, width);
    }
  }
}

// Whole rows at a time, so that the compiler turns the inner loops into vector instructions.
void DistanceTransform::measure_columns(std::span<const std::uint8_t> sources) {
  const auto w = static_cast<std::size_t>(width_);
  const auto h = static_cast<std::size_t>(height_);
  const auto cap = static_cast<std::uint16_t>(cap_);
  for (std::size_t y = 0; y < h; ++y) {
    const std::uint8_t* source = &sources[y * w];
    std::uint16_t* row = &column_distance_[y * w];
    const std::uint16_t* above = y == 0 ? nullptr : row - w;
    for (std::size_t x = 0; x < w; ++x) {
      const std::uint16_t reached = above ? one_more(above[x], cap) : cap;
      row[x] = source[x] != 0 ? std::uint16_t{0} : reached;
    }
  }
  for (std::size_t y = h; y-- > 1;) {
    const std::uint16_t* row = &column_distance_[y * w];
    std::uint16_t* next = &column_distance_[(y - 1) * w];
    for (std::size_t x = 0; x < w; ++x) next[x] = std::min(next[x], one_more(row[x], cap));
  }
}

// Precondition: `first` is a multiple of a block.
void DistanceTransform::measure_run(const std::uint16_t* column_distance, std::int32_t* squared,
                                    int first, int last) {
  const auto limit = static_cast<std::int16_t>(cap_ * cap_);
  const int margin = (cap_ + kRoundsAtOnce + kBlock - 1) / kBlock;  // blocks
  const int blocks = (last - first + kBlock - 1) / kBlock;
  const auto size = static_cast<std::size_t>((blocks + 2 * margin) * kBlock);
  squares_.assign(size, limit);
  const int from = std::max(0, first - margin * kBlock);
  const int until = std::min(width_, first + (blocks + margin) * kBlock);
  std::int16_t* const middle = squares_.data() + margin * kBlock;  // of the cell `first`
  for (int x = from; x < until; ++x) {
    const auto g = static_cast<std::int16_t>(column_distance[x]);
    middle[x - first] = static_cast<std::int16_t>(g * g);
  }
  near_.resize(size / kBlock);
  for (std::size_t block = 0; block < near_.size(); ++block) {
    std::uint8_t near = 0;
    for (std::size_t i = 0; i < kBlock; ++i) {
      near = static_cast<std::uint8_t>(near | (squares_[block * kBlock + i] < limit ? 1 : 0));
    }
    near_[block] = near;
  }
  int last_near = -1;  // the rightmost near block among those that the present one can feel
  for (int block = 0; block < margin * 2 && block < blocks + 2 * margin; ++block) {
    if (near_[static_cast<std::size_t>(block)] != 0) last_near = block;
  }
  for (int block = 0; block < blocks; ++block) {
    if (near_[static_cast<std::size_t>(block + 2 * margin)] != 0) last_near = block + 2 * margin;
    const int x = first + block * kBlock;
    const int count = std::min(kBlock, width_ - x);
    if (last_near < block) {
      std::fill_n(squared + x, count, static_cast<std::int32_t>(limit));
      continue;
    }
    std::int16_t best[kBlock];
    measure_block(middle + block * kBlock, best);
    std::copy_n(best, count, squared + x);
  }
}

// Crossings of parabolas are compared as doubles. Two different crossings in a row of at most 32767
// cells differ by more than 1e-10, far above the rounding error, and where two are equal either
// choice gives the same value: the result is exact. A table of inverses in place of the division
// earns a third of the run (bench core_costmap, warehouse).
void DistanceTransform::measure_row(const std::uint16_t* column_distance, std::int32_t* squared) {
  const int width = width_;
  const std::int32_t limit = cap_ * cap_;
  std::size_t count = 0;
  for (std::int32_t x = 0; x < width; ++x) {
    const std::int32_t g = column_distance[x];
    if (g >= cap_) continue;
    const std::int32_t height = g * g;
    double from = 0.0;
    while (count > 0) {
      const Parabola& last = envelope_[count - 1];
      const std::int64_t between = x - last.vertex;
      const std::int64_t rise = height - last.height + between * (x + last.vertex);
      from = static_cast<double>(rise) * half_inverse_[static_cast<std::size_t>(between)];
      if (from > last.from) break;
      --count;
      from = 0.0;
    }
    if (from < width) envelope_[count++] = {x, height, from};
  }
  std::int32_t x = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Parabola& lowest = envelope_[i];
    const double until = i + 1 < count ? envelope_[i + 1].from : static_cast<double>(width);
    const auto end = std::min(width, static_cast<std::int32_t>(std::ceil(until)));
    for (; x < end; ++x) {
      const std::int32_t offset = x - lowest.vertex;
      squared[x] = std::min(limit, offset * offset + lowest.height);
    }
  }
  for (; x < width; ++x) squared[x] = limit;
}

std::span<const CellRun> DistanceTransform::update(std::span<const std::uint8_t> sources,
                                                   std::span<const CellWindow> changed,
                                                   std::span<std::int32_t> squared_cells) {
  const auto w = static_cast<std::size_t>(width_);
  runs_.clear();
  if (cap_ > kSmallCap) {
    run(sources, width_, height_, squared_cells, cap_);
    for (int y = 0; y < height_; ++y) runs_.push_back({y, 0, width_});
    return runs_;
  }
  const auto words = static_cast<std::size_t>(width_ / (kBlock * 64) + 1);
  stale_.resize(words * static_cast<std::size_t>(height_), 0);
  reach_.resize(static_cast<std::size_t>(cap_) + 1);
  for (int g = 0; g <= cap_; ++g) {
    reach_[static_cast<std::size_t>(g)] = static_cast<std::uint8_t>(std::sqrt(cap_ * cap_ - g * g));
  }
  for (const CellWindow& window : changed) {
    const CellWindow inside{{std::max(0, window.low.x), std::max(0, window.low.y)},
                            {std::min(width_, window.high.x), std::min(height_, window.high.y)}};
    if (inside.low.x < inside.high.x && inside.low.y < inside.high.y) {
      update_columns(sources, inside);
    }
  }
  collect_runs();
  for (const CellRun& run : runs_) {
    const std::size_t row = static_cast<std::size_t>(run.y) * w;
    measure_run(&column_distance_[row], &squared_cells[row], run.first, run.last);
  }
  return runs_;
}

// Beyond the cap above and below the window its sources are not felt: the rows there are right, and
// what they say is where both sweeps start from. Where another window is felt there too, that one's
// own rows include all that came out wrong for it.
void DistanceTransform::update_columns(std::span<const std::uint8_t> sources,
                                       const CellWindow& window) {
  const int low = std::max(0, window.low.y - cap_);
  const int high = std::min(height_, window.high.y + cap_);
  const auto cap = static_cast<std::uint16_t>(cap_);
  const auto width = static_cast<std::size_t>(window.high.x - window.low.x);
  const auto at = [&](int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(window.low.x);
  };
  // A row more at either end: what lies beyond.
  columns_.assign(width * static_cast<std::size_t>(high - low + 2), cap);
  if (low > 0) std::copy_n(&column_distance_[at(low - 1)], width, columns_.data());
  if (high < height_) {
    std::copy_n(&column_distance_[at(high)], width, columns_.data() + columns_.size() - width);
  }
  std::uint16_t* row = columns_.data() + width;
  for (int y = low; y < high; ++y, row += width) {
    const std::uint8_t* source = &sources[at(y)];
    const std::uint16_t* above = row - width;
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint16_t reached = one_more(above[x], cap);
      row[x] = source[x] != 0 ? std::uint16_t{0} : reached;
    }
  }
  for (int y = high; y-- > low;) {
    const std::uint16_t* below = row;
    row -= width;
    std::uint16_t* old = &column_distance_[at(y)];
    int first = window.high.x;
    int last = window.low.x;
    std::uint16_t nearest = cap;
    for (std::size_t x = 0; x < width; ++x) {
      row[x] = std::min(row[x], one_more(below[x], cap));
      if (row[x] == old[x]) continue;
      nearest = std::min({nearest, row[x], old[x]});
      old[x] = row[x];
      first = std::min(first, window.low.x + static_cast<int>(x));
      last = window.low.x + static_cast<int>(x) + 1;
    }
    const int reach = reach_[nearest];
    if (first < last) mark(y, std::max(0, first - reach), std::min(width_, last + reach));
  }
}

void DistanceTransform::mark(int y, int first, int last) {
  const auto words = static_cast<std::size_t>(width_ / (kBlock * 64) + 1);
  std::uint64_t* row = &stale_[static_cast<std::size_t>(y) * words];
  for (int block = first / kBlock; block <= (last - 1) / kBlock; ++block) {
    row[block / 64] |= std::uint64_t{1} << static_cast<unsigned>(block % 64);
  }
}

void DistanceTransform::collect_runs() {
  const int words = width_ / (kBlock * 64) + 1;
  for (std::size_t i = 0; i < stale_.size(); ++i) {
    std::uint64_t bits = stale_[i];
    if (bits == 0) continue;
    stale_[i] = 0;
    const int y = static_cast<int>(i) / words;
    const int base = static_cast<int>(i) % words * 64;
    while (bits != 0) {
      const int from = std::countr_zero(bits);
      const int length = std::countr_one(bits >> static_cast<unsigned>(from));
      runs_.push_back(
          {y, (base + from) * kBlock, std::min(width_, (base + from + length) * kBlock)});
      if (from + length >= 64) break;
      bits &= ~std::uint64_t{0} << static_cast<unsigned>(from + length);
    }
  }
}

Grid<float> distance_to_occupied(const OccupancyGrid& map, double max_distance,
                                 std::int8_t occupied_from) {
  const GridGeometry& geometry = map.geometry;
  std::vector<std::uint8_t> sources(map.cells.size());
  std::transform(map.cells.begin(), map.cells.end(), sources.begin(),
                 [occupied_from](std::int8_t cell) { return cell >= occupied_from ? 1 : 0; });
  std::vector<std::int32_t> squared(map.cells.size());
  const double cap = std::ceil(max_distance / geometry.resolution);
  DistanceTransform transform;
  transform.run(
      sources, geometry.width, geometry.height, squared,
      cap < DistanceTransform::kNoCap ? static_cast<int>(cap) : DistanceTransform::kNoCap);
  Grid<float> distance(geometry, 0.0F);
  std::transform(squared.begin(), squared.end(), distance.cells.begin(), [&](std::int32_t d) {
    const double metres = std::sqrt(static_cast<double>(d)) * geometry.resolution;
    return static_cast<float>(std::min(metres, max_distance));
  });
  return distance;
}

}  // namespace coop
