#include "core/costmap/distance_transform.hpp"

#include <algorithm>
#include <cmath>

namespace coop {

void DistanceTransform::run(std::span<const std::uint8_t> sources, int width, int height,
                            std::span<std::int32_t> squared_cells, int cap) {
  const auto w = static_cast<std::size_t>(width);
  cap_ = std::clamp(cap, 1, kNoCap);
  column_distance_.resize(w * static_cast<std::size_t>(height));
  envelope_.resize(w);
  for (std::size_t d = half_inverse_.size(); d <= w; ++d) {
    half_inverse_.push_back(d == 0 ? 0.0 : 0.5 / static_cast<double>(d));
  }
  measure_columns(sources, width, height);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    measure_row(&column_distance_[y * w], width, &squared_cells[y * w]);
  }
}

// Whole rows at a time, so that the compiler turns the inner loops into vector instructions.
void DistanceTransform::measure_columns(std::span<const std::uint8_t> sources, int width,
                                        int height) {
  const auto w = static_cast<std::size_t>(width);
  const auto h = static_cast<std::size_t>(height);
  const auto cap = static_cast<std::uint16_t>(cap_);
  const auto step = [cap](std::uint16_t neighbour) {
    return static_cast<std::uint16_t>(neighbour < cap ? neighbour + 1 : cap);
  };
  for (std::size_t y = 0; y < h; ++y) {
    const std::uint8_t* source = &sources[y * w];
    std::uint16_t* row = &column_distance_[y * w];
    const std::uint16_t* above = y == 0 ? nullptr : row - w;
    for (std::size_t x = 0; x < w; ++x) {
      const std::uint16_t reached = above ? step(above[x]) : cap;
      row[x] = source[x] != 0 ? std::uint16_t{0} : reached;
    }
  }
  for (std::size_t y = h; y-- > 1;) {
    const std::uint16_t* row = &column_distance_[y * w];
    std::uint16_t* next = &column_distance_[(y - 1) * w];
    for (std::size_t x = 0; x < w; ++x) next[x] = std::min(next[x], step(row[x]));
  }
}

// Crossings of parabolas are compared as doubles. Two different crossings in a row of at most 32767
// cells differ by more than 1e-10, far above the rounding error, and where two are equal either
// choice gives the same value: the result is exact. A table of inverses in place of the division
// earns a third of the run (bench core_costmap, warehouse).
void DistanceTransform::measure_row(const std::uint16_t* column_distance, int width,
                                    std::int32_t* squared) {
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
