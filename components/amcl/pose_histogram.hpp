#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/pose.hpp"

namespace coop::amcl {

/// Sparse histogram over (x, y, yaw) in an open-addressing table: what KLD-sampling counts and what
/// the clusters are grown in. Storage is kept from use to use; clear() is O(1).
class PoseHistogram {
 public:
  /// Bins of `size` m by `size` m by about `yaw_size` rad (the turn is divided evenly). Holds up to
  /// `capacity` bins.
  PoseHistogram(double size, double yaw_size, std::size_t capacity);

  void clear();
  /// Adds weight to the bin of the pose and returns the bin's number (0, 1, ... in order of first
  /// use).
  std::uint32_t add(double x, double y, double yaw, double weight);

  [[nodiscard]] std::size_t bin_count() const { return bins_.size(); }
  [[nodiscard]] double weight(std::uint32_t bin) const { return bins_[bin].weight; }

  /// Numbers the connected components (26 neighbours, yaw is cyclic) of the filled bins:
  /// labels[bin] in 0 ... count - 1. Returns the count.
  std::size_t label_components(std::vector<std::uint32_t>& labels);

 private:
  struct Bin {
    std::int32_t x, y, yaw;
    double weight;
  };
  struct Slot {
    std::uint32_t generation = 0;
    std::uint32_t bin = 0;
  };

  [[nodiscard]] std::size_t find_slot(std::int32_t x, std::int32_t y, std::int32_t yaw) const;
  void visit_neighbours(std::uint32_t bin, std::uint32_t label, std::vector<std::uint32_t>& labels);

  double per_metre_;
  double per_radian_;
  std::int32_t yaw_bins_;
  std::size_t mask_;
  std::uint32_t generation_ = 1;
  std::vector<Slot> slots_;
  std::vector<Bin> bins_;
  std::vector<std::uint32_t> queue_;
};

}  // namespace coop::amcl
