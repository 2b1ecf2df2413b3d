#include "sequencer/tour_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coop::sequencer {
namespace {

/// Floods sum up floats: there and back differ in the last digits.
constexpr double kSameShare = 1e-4;
constexpr double kSameCost = 1e-6;

}  // namespace

bool is_symmetric(const CostMatrix& costs) {
  for (std::size_t a = 0; a < costs.size; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double there = costs.at(a, b);
      const double back = costs.at(b, a);
      if (std::abs(there - back) > kSameCost + kSameShare * std::max(there, back)) return false;
    }
  }
  return true;
}

TourProblem::TourProblem(const CostMatrix& costs, bool closed, std::size_t neighbours)
    : nodes_(costs.size) {
  if (is_symmetric(costs)) {
    fill_symmetric(costs, closed);
  } else {
    fill_asymmetric(costs, closed);
  }
  neighbours_of_each_ = std::min(neighbours, nodes_ - 1);
  find_neighbours();
}

void TourProblem::fill_symmetric(const CostMatrix& costs, bool closed) {
  size_ = closed ? nodes_ : nodes_ + 1;
  cost_.assign(size_ * size_, 0.0);
  for (std::size_t a = 0; a < nodes_; ++a) {
    for (std::size_t b = 0; b < nodes_; ++b) {
      if (a != b) cost_[a * size_ + b] = 0.5 * (costs.at(a, b) + costs.at(b, a));
    }
  }
  partner_.resize(size_);
  std::iota(partner_.begin(), partner_.end(), Vertex{0});
  if (!closed) std::swap(partner_.front(), partner_.back());
}

void TourProblem::fill_asymmetric(const CostMatrix& costs, bool closed) {
  size_ = 2 * nodes_;
  cost_.assign(size_ * size_, kForbidden);
  partner_.resize(size_);
  for (std::size_t a = 0; a < nodes_; ++a) {
    const std::size_t exit = nodes_ + a;
    partner_[a] = static_cast<Vertex>(exit);
    partner_[exit] = static_cast<Vertex>(a);
    for (std::size_t b = 0; b < nodes_; ++b) {
      const double price = a == b || (b == 0 && !closed) ? 0.0 : costs.at(a, b);
      cost_[exit * size_ + b] = price;
      cost_[b * size_ + exit] = price;
    }
  }
}

void TourProblem::find_neighbours() {
  neighbours_.resize(size_ * neighbours_of_each_);
  std::vector<Vertex> others;
  others.reserve(size_);
  for (Vertex v = 0; v < size_; ++v) {
    others.clear();
    for (Vertex w = 0; w < size_; ++w) {
      const bool is_end = has_end() && w == end();
      if (w != v && !is_end && w != partner_[v] && cost(v, w) < kForbidden) others.push_back(w);
    }
    std::ranges::partial_sort(others,
                              others.begin() + static_cast<std::ptrdiff_t>(neighbours_of_each_),
                              [&](Vertex a, Vertex b) {
                                return cost(v, a) != cost(v, b) ? cost(v, a) < cost(v, b) : a < b;
                              });
    std::copy_n(others.begin(), neighbours_of_each_,
                neighbours_.begin() + static_cast<std::ptrdiff_t>(v * neighbours_of_each_));
  }
}

double TourProblem::length(std::span<const Vertex> tour) const {
  double sum = cost(tour.back(), tour.front());
  for (std::size_t i = 1; i < tour.size(); ++i) sum += cost(tour[i - 1], tour[i]);
  return sum;
}

std::vector<std::size_t> TourProblem::order(std::span<const Vertex> tour) const {
  const auto start = static_cast<std::size_t>(std::ranges::find(tour, Vertex{0}) - tour.begin());
  const Vertex partner = partner_.front();
  const Vertex before = tour[(start + size_ - 1) % size_];
  // The end stands before the start of an open tour, the start's exit behind its entry.
  const bool is_backward = partner != 0 && (before == partner) != has_end();
  const std::size_t step = is_backward ? size_ - 1 : 1;
  std::vector<std::size_t> order;
  order.reserve(nodes_ - 1);
  for (std::size_t i = 1, at = start; i < size_; ++i) {
    at = (at + step) % size_;
    if (tour[at] < nodes_) order.push_back(tour[at]);
  }
  return order;
}

}  // namespace coop::sequencer
