#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sequencer/cost_matrix.hpp"

namespace coop::sequencer {

/// The order of a cost matrix as a closed tour with symmetric costs, the only form that local
/// search and ants below have to know. Some vertices come in pairs joined by a fixed edge:
/// - closed, symmetric: the nodes themselves, no pairs;
/// - open, symmetric: one vertex more, the end, at no cost from anywhere and joined to the start;
/// - asymmetric: two vertices a node, entry and exit, joined; the cost from a to b lies between
///   a's exit and b's entry (Jonker, Volgenant 1983). Open: coming back to the start is free.
class TourProblem {
 public:
  using Vertex = std::uint32_t;

  /// Precondition: costs are finite, at least two nodes.
  TourProblem(const CostMatrix& costs, bool closed, std::size_t neighbours);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double cost(Vertex a, Vertex b) const { return cost_[a * size_ + b]; }
  /// The vertex that `v` is joined to for good, or `v` itself.
  [[nodiscard]] Vertex partner(Vertex v) const { return partner_[v]; }
  [[nodiscard]] bool is_fixed(Vertex a, Vertex b) const { return partner_[a] == b && a != b; }
  [[nodiscard]] std::size_t neighbours_of_each() const { return neighbours_of_each_; }
  /// The vertices cheapest to go to, cheapest first; neither the partner nor the end of an open
  /// tour is among them.
  [[nodiscard]] std::span<const Vertex> neighbours(Vertex v) const {
    return {neighbours_.data() + v * neighbours_of_each_, neighbours_of_each_};
  }
  [[nodiscard]] bool has_end() const { return size_ == nodes_ + 1; }
  /// The end of an open symmetric tour.
  [[nodiscard]] Vertex end() const { return static_cast<Vertex>(nodes_); }

  [[nodiscard]] double length(std::span<const Vertex> tour) const;
  /// Nodes 1 to n-1 in the order of a tour of all vertices.
  [[nodiscard]] std::vector<std::size_t> order(std::span<const Vertex> tour) const;

  /// Between two entries or two exits.
  static constexpr double kForbidden = std::numeric_limits<double>::infinity();

 private:
  void fill_symmetric(const CostMatrix& costs, bool closed);
  void fill_asymmetric(const CostMatrix& costs, bool closed);
  void find_neighbours();

  std::size_t nodes_ = 0;
  std::size_t size_ = 0;
  std::size_t neighbours_of_each_ = 0;
  std::vector<double> cost_;
  std::vector<Vertex> partner_;
  std::vector<Vertex> neighbours_;
};

/// Whether the costs there and back differ by no more than the rounding of path costs.
[[nodiscard]] bool is_symmetric(const CostMatrix& costs);

}  // namespace coop::sequencer
