#include "sequencer/local_search.hpp"

#include <algorithm>
#include <utility>

namespace coop::sequencer {
namespace {

/// Of the largest cost: what rounding could make up is no gain.
constexpr double kLeastGainShare = 1e-10;

}  // namespace

LocalSearch::LocalSearch(const TourProblem& problem)
    : problem_(problem),
      place_(problem.size()),
      queue_(problem.size()),
      is_queued_(problem.size(), 0),
      reference_next_(problem.size()) {
  double largest = 0.0;
  for (Vertex v = 0; v < problem.size(); ++v) {
    for (Vertex w = 0; w < v; ++w) {
      const double cost = problem.cost(v, w);
      if (cost < TourProblem::kForbidden) largest = std::max(largest, cost);
    }
  }
  least_gain_ = kLeastGainShare * largest;
}

void LocalSearch::improve(std::span<Vertex> tour, std::span<const Vertex> reference) {
  tour_ = tour;
  for (std::size_t i = 0; i < tour.size(); ++i) place_[tour[i]] = static_cast<Vertex>(i);
  wake_all(reference);
  while (queue_length_ > 0) {
    const Vertex v = queue_[queue_begin_];
    queue_begin_ = queue_begin_ + 1 == queue_.size() ? 0 : queue_begin_ + 1;
    --queue_length_;
    is_queued_[v] = 0;
    while (improve_at(v)) {
    }
  }
}

void LocalSearch::wake_all(std::span<const Vertex> reference) {
  queue_begin_ = 0;
  queue_length_ = 0;
  std::ranges::fill(is_queued_, std::uint8_t{0});
  if (reference.empty()) {
    for (const Vertex v : tour_) wake(v);
    return;
  }
  for (std::size_t i = 0; i < reference.size(); ++i) {
    reference_next_[reference[i]] = reference[i + 1 == reference.size() ? 0 : i + 1];
  }
  for (const Vertex v : tour_) {
    const Vertex follower = next(v);
    if (reference_next_[v] == follower || reference_next_[follower] == v) continue;
    wake(v);
    wake(follower);
  }
}

void LocalSearch::wake(Vertex v) {
  if (is_queued_[v] != 0) return;
  is_queued_[v] = 1;
  std::size_t end = queue_begin_ + queue_length_;
  if (end >= queue_.size()) end -= queue_.size();
  queue_[end] = v;
  ++queue_length_;
}

TourProblem::Vertex LocalSearch::next(Vertex v) const {
  const std::size_t place = place_[v] + std::size_t{1};
  return tour_[place == tour_.size() ? 0 : place];
}

TourProblem::Vertex LocalSearch::previous(Vertex v) const {
  const std::size_t place = place_[v];
  return tour_[(place == 0 ? tour_.size() : place) - 1];
}

bool LocalSearch::lies_between(Vertex first, Vertex v, Vertex last, Way way) const {
  if (way == Way::kBackward) std::swap(first, last);
  const Vertex a = place_[first];
  const Vertex b = place_[v];
  const Vertex c = place_[last];
  return a <= c ? a <= b && b <= c : b >= a || b <= c;
}

bool LocalSearch::improve_at(Vertex t1) {
  return improve_from(t1, Way::kForward) || improve_from(t1, Way::kBackward);
}

/// Takes t1-t2 out and puts t2-t3 in; what else changes depends on the neighbour of t3 that is let
/// go of.
bool LocalSearch::improve_from(Vertex t1, Way way) {
  const Vertex t2 = after(t1, way);
  if (problem_.is_fixed(t1, t2)) return false;
  const double taken = problem_.cost(t1, t2);
  for (const Vertex t3 : problem_.neighbours(t2)) {
    const double gain = taken - problem_.cost(t2, t3);
    if (gain <= least_gain_) return false;
    if (t3 == t1 || t3 == after(t2, way)) continue;
    if (reverse_twice(t1, t2, t3, way, gain) || move_segment(t1, t2, t3, way, gain)) return true;
  }
  return false;
}

/// t4 before t3: the tour closes again with t4-t1 (2-opt), or goes on to take a third edge.
bool LocalSearch::reverse_twice(Vertex t1, Vertex t2, Vertex t3, Way way, double gain) {
  const Vertex t4 = before(t3, way);
  if (problem_.is_fixed(t3, t4)) return false;
  gain += problem_.cost(t3, t4);
  if (gain - problem_.cost(t4, t1) > least_gain_) {
    exchange(t1, t2, t3, t4);
    return true;
  }
  for (const Vertex t5 : problem_.neighbours(t4)) {
    const double rest = gain - problem_.cost(t4, t5);
    if (rest <= least_gain_) return false;
    if (t5 == t3 || t5 == t1 || t5 == before(t4, way)) continue;
    // What lies from t2 to t4 runs the other way now.
    const Vertex t6 = lies_between(t2, t5, t4, way) ? after(t5, way) : before(t5, way);
    if (problem_.is_fixed(t5, t6)) continue;
    if (rest + problem_.cost(t5, t6) - problem_.cost(t6, t1) <= least_gain_) continue;
    exchange(t1, t2, t3, t4);
    exchange(t1, t4, t5, t6);
    return true;
  }
  return false;
}

/// t4 behind t3: t2 to t3 has become a ring of its own, which is opened at t5-t6 and put in between
/// t1 and t4.
bool LocalSearch::move_segment(Vertex t1, Vertex t2, Vertex t3, Way way, double gain) {
  const Vertex t4 = after(t3, way);
  if (problem_.is_fixed(t3, t4)) return false;
  gain += problem_.cost(t3, t4);
  for (const Vertex t5 : problem_.neighbours(t4)) {
    const double rest = gain - problem_.cost(t4, t5);
    if (rest <= least_gain_) return false;
    if (t5 == t3 || !lies_between(t2, t5, t3, way)) continue;
    const auto pays = [&](Vertex t6) {
      return !problem_.is_fixed(t5, t6) &&
             rest + problem_.cost(t5, t6) - problem_.cost(t6, t1) > least_gain_;
    };
    if (const Vertex t6 = after(t5, way); pays(t6)) {  // both parts keep their direction
      exchange(t1, t2, t4, t3);
      exchange(t1, t3, t5, t6);
      exchange(t3, t5, t4, t2);
      return true;
    }
    if (t5 == t2) continue;
    if (const Vertex t6 = before(t5, way); pays(t6)) {  // both parts are turned round
      exchange(t1, t2, t5, t6);
      exchange(t2, t5, t4, t3);
      return true;
    }
  }
  return false;
}

void LocalSearch::exchange(Vertex a, Vertex b, Vertex c, Vertex d) {
  if (next(a) == b) {
    reverse(b, d);
  } else {
    reverse(d, b);
  }
  for (const Vertex v : {a, b, c, d}) wake(v);
}

/// The part from `first` on to `last`, or all that is not in it, whichever is shorter: as a ring
/// the tour is the same.
void LocalSearch::reverse(Vertex first, Vertex last) {
  const std::size_t size = tour_.size();
  std::size_t low = place_[first];
  std::size_t high = place_[last];
  std::size_t length = (high >= low ? high - low : high + size - low) + 1;
  if (2 * length > size) {
    std::swap(low, high);
    low = low + 1 == size ? 0 : low + 1;
    high = high == 0 ? size - 1 : high - 1;
    length = size - length;
  }
  for (std::size_t i = 0; i < length / 2; ++i) {
    std::swap(tour_[low], tour_[high]);
    place_[tour_[low]] = static_cast<Vertex>(low);
    place_[tour_[high]] = static_cast<Vertex>(high);
    low = low + 1 == size ? 0 : low + 1;
    high = high == 0 ? size - 1 : high - 1;
  }
}

}  // namespace coop::sequencer
