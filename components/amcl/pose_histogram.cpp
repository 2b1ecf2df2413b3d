#include "amcl/pose_histogram.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace coop::amcl {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::uint32_t kUnlabelled = ~std::uint32_t{0};

std::size_t hash(std::int32_t x, std::int32_t y, std::int32_t yaw) {
  std::uint64_t h = static_cast<std::uint32_t>(x) * 0x9E3779B97F4A7C15ULL;
  h ^= static_cast<std::uint32_t>(y) * 0xC2B2AE3D27D4EB4FULL + (h >> 29);
  h ^= static_cast<std::uint32_t>(yaw) * 0x165667B19E3779F9ULL + (h >> 31);
  return static_cast<std::size_t>(h ^ (h >> 32));
}

}  // namespace

PoseHistogram::PoseHistogram(double size, double yaw_size, std::size_t capacity)
    : per_metre_(1.0 / size),
      per_radian_(std::max(1.0, std::round(kTurn / yaw_size)) / kTurn),
      yaw_bins_(static_cast<std::int32_t>(std::max(1.0, std::round(kTurn / yaw_size)))),
      mask_(std::bit_ceil(2 * std::max<std::size_t>(capacity, 8)) - 1),
      slots_(mask_ + 1) {
  bins_.reserve(capacity);
  queue_.reserve(capacity);
}

void PoseHistogram::clear() {
  bins_.clear();
  if (++generation_ == 0) {  // wrapped round: old marks could look fresh
    std::fill(slots_.begin(), slots_.end(), Slot{});
    generation_ = 1;
  }
}

std::size_t PoseHistogram::find_slot(std::int32_t x, std::int32_t y, std::int32_t yaw) const {
  std::size_t slot = hash(x, y, yaw) & mask_;
  while (slots_[slot].generation == generation_) {
    const Bin& bin = bins_[slots_[slot].bin];
    if (bin.x == x && bin.y == y && bin.yaw == yaw) break;
    slot = (slot + 1) & mask_;
  }
  return slot;
}

std::uint32_t PoseHistogram::add(double x, double y, double yaw, double weight) {
  const auto ix = static_cast<std::int32_t>(std::floor(x * per_metre_));
  const auto iy = static_cast<std::int32_t>(std::floor(y * per_metre_));
  auto iyaw =
      static_cast<std::int32_t>(std::floor((normalize_angle(yaw) + kTurn / 2) * per_radian_));
  iyaw = std::min(iyaw, yaw_bins_ - 1);
  const std::size_t slot = find_slot(ix, iy, iyaw);
  if (slots_[slot].generation != generation_) {
    slots_[slot] = {generation_, static_cast<std::uint32_t>(bins_.size())};
    bins_.push_back({ix, iy, iyaw, 0.0});
  }
  bins_[slots_[slot].bin].weight += weight;
  return slots_[slot].bin;
}

void PoseHistogram::visit_neighbours(std::uint32_t bin, std::uint32_t label,
                                     std::vector<std::uint32_t>& labels) {
  const Bin center = bins_[bin];
  for (std::int32_t dyaw = -1; dyaw <= 1; ++dyaw) {
    const std::int32_t yaw = (center.yaw + dyaw + yaw_bins_) % yaw_bins_;
    for (std::int32_t dy = -1; dy <= 1; ++dy) {
      for (std::int32_t dx = -1; dx <= 1; ++dx) {
        const Slot& slot = slots_[find_slot(center.x + dx, center.y + dy, yaw)];
        if (slot.generation != generation_ || labels[slot.bin] != kUnlabelled) continue;
        labels[slot.bin] = label;
        queue_.push_back(slot.bin);
      }
    }
  }
}

std::size_t PoseHistogram::label_components(std::vector<std::uint32_t>& labels) {
  labels.assign(bins_.size(), kUnlabelled);
  std::uint32_t count = 0;
  for (std::uint32_t seed = 0; seed < bins_.size(); ++seed) {
    if (labels[seed] != kUnlabelled) continue;
    labels[seed] = count;
    queue_.assign(1, seed);
    while (!queue_.empty()) {
      const std::uint32_t bin = queue_.back();
      queue_.pop_back();
      visit_neighbours(bin, count, labels);
    }
    ++count;
  }
  return count;
}

}  // namespace coop::amcl
