#pragma once
#include <span>
#include <vector>

#include "sequencer/tour_problem.hpp"

namespace coop::sequencer {

/// Improves a tour until no exchange of two or three edges in sequence does (Lin 1965: 2-opt,
/// 3-opt; Or's moving of segments, of any length and either way round, is among them). New edges
/// lead to neighbours only and the sum of gains stays positive on the way (Lin, Kernighan 1973);
/// a vertex is looked at again only after an edge of it changed (don't-look bits, Bentley 1992).
/// Fixed edges stay. The tour is a flat array with each vertex's place in it.
class LocalSearch {
 public:
  using Vertex = TourProblem::Vertex;

  explicit LocalSearch(const TourProblem& problem);

  /// Improves `tour` in place; `reference` is a tour that was improved before, or empty: what lies
  /// as it does there is looked at only when its surroundings change.
  void improve(std::span<Vertex> tour, std::span<const Vertex> reference);

 private:
  enum class Way { kForward, kBackward };

  void wake_all(std::span<const Vertex> reference);
  void wake(Vertex v);
  [[nodiscard]] Vertex next(Vertex v) const;
  [[nodiscard]] Vertex previous(Vertex v) const;
  /// Along `way`.
  [[nodiscard]] Vertex after(Vertex v, Way way) const {
    return way == Way::kForward ? next(v) : previous(v);
  }
  [[nodiscard]] Vertex before(Vertex v, Way way) const {
    return way == Way::kForward ? previous(v) : next(v);
  }
  /// Whether one meets `v` on the way from `first` to `last`.
  [[nodiscard]] bool lies_between(Vertex first, Vertex v, Vertex last, Way way) const;

  [[nodiscard]] bool improve_at(Vertex t1);
  [[nodiscard]] bool improve_from(Vertex t1, Way way);
  [[nodiscard]] bool reverse_twice(Vertex t1, Vertex t2, Vertex t3, Way way, double gain);
  [[nodiscard]] bool move_segment(Vertex t1, Vertex t2, Vertex t3, Way way, double gain);
  /// Takes edges a-b and c-d out and puts b-c and d-a in; b follows a as c follows d.
  void exchange(Vertex a, Vertex b, Vertex c, Vertex d);
  void reverse(Vertex first, Vertex last);

  const TourProblem& problem_;
  double least_gain_ = 0.0;
  std::span<Vertex> tour_;
  std::vector<Vertex> place_;
  std::vector<Vertex> queue_;  ///< a ring of vertices to be looked at, none twice
  std::size_t queue_begin_ = 0;
  std::size_t queue_length_ = 0;
  std::vector<std::uint8_t> is_queued_;
  std::vector<Vertex> reference_next_;
};

}  // namespace coop::sequencer
