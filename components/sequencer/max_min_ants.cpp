#include "sequencer/max_min_ants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sequencer/local_search.hpp"

namespace coop::sequencer {

void MaxMinConfig::describe(config::Fields& fields) {
  fields.integer("ants", ants, {.help = "an iteration", .min = 1, .max = 1000});
  fields.integer("iterations", iterations, {.help = "bound of time", .min = 1, .max = 100000});
  fields.integer("neighbours", neighbours,
                 {.help = "of each place, to choose from", .min = 3, .max = 50});
  fields.number("alpha", alpha, {.help = "importance of pheromone", .min = 0, .max = 10});
  fields.number("beta", beta, {.help = "importance of 1 / distance", .min = 0, .max = 10});
  fields.number("rho", rho, {.help = "evaporation an iteration", .min = 0.001, .max = 1});
  fields.integer("patience", patience,
                 {.help = "iterations without a better tour until trails begin anew", .min = 1});
}

namespace {

using Vertex = TourProblem::Vertex;

/// Of the mean cost to a neighbour: nearer places attract no more.
constexpr double kShortestShare = 1e-3;
/// The best tour since the trails began leaves pheromone in place of the iteration's best ant:
/// seldom at first, always in the end.
constexpr int kBestEvery[] = {25, 5, 3, 2};

class MaxMinAnts {
 public:
  MaxMinAnts(const TourProblem& problem, const MaxMinConfig& config, RandomStream& random)
      : problem_(problem),
        config_(config),
        random_(random),
        search_(problem),
        width_(problem.neighbours_of_each()),
        heuristic_(problem.size() * width_),
        trail_(heuristic_.size(), 1.0),
        attraction_(heuristic_.size()),
        walk_(problem.size()),
        iteration_best_(problem.size()),
        unvisited_(problem.size()),
        place_in_unvisited_(problem.size()),
        weights_(width_) {
    fill_heuristic();
  }

  std::vector<Vertex> run() {
    begin_trails_anew();
    for (int iteration = 0; iteration < config_.iterations; ++iteration) {
      refresh_attraction();
      const double length = send_ants();
      note(length);
      if (best_length_ <= 0.0) break;
      update_trails(length);
      if (++since_better_ > config_.patience) begin_trails_anew();
    }
    return best_;
  }

 private:
  void fill_heuristic() {
    double sum = 0.0;
    for (Vertex v = 0; v < problem_.size(); ++v) {
      for (const Vertex w : problem_.neighbours(v)) sum += problem_.cost(v, w);
    }
    const double mean = sum / static_cast<double>(heuristic_.size());
    const double shortest = mean > 0.0 ? kShortestShare * mean : 1.0;
    auto entry = heuristic_.begin();
    for (Vertex v = 0; v < problem_.size(); ++v) {
      for (const Vertex w : problem_.neighbours(v)) {
        *entry++ = std::pow(mean / std::max(problem_.cost(v, w), shortest), config_.beta);
      }
    }
  }

  void begin_trails_anew() {
    std::ranges::fill(trail_, 1.0);
    round_best_length_ = std::numeric_limits<double>::infinity();
    since_better_ = 0;
    age_ = 0;
  }

  void refresh_attraction() {
    for (std::size_t i = 0; i < trail_.size(); ++i) {
      const double trail = config_.alpha == 1.0 ? trail_[i] : std::pow(trail_[i], config_.alpha);
      attraction_[i] = trail * heuristic_[i];
    }
  }

  /// Leaves the best ant's tour in iteration_best_; answers its length.
  double send_ants() {
    double best = std::numeric_limits<double>::infinity();
    for (int ant = 0; ant < config_.ants; ++ant) {
      walk();
      search_.improve(walk_, round_best_);
      const double length = problem_.length(walk_);
      if (length >= best) continue;
      best = length;
      std::swap(walk_, iteration_best_);
    }
    return best;
  }

  void walk() {
    for (Vertex v = 0; v < unvisited_.size(); ++v) unvisited_[v] = place_in_unvisited_[v] = v;
    left_ = unvisited_.size();
    // An open tour begins where the robot stands; where a closed one does is all the same.
    Vertex here =
        problem_.has_end() ? problem_.end() : static_cast<Vertex>(random_.below(problem_.size()));
    for (std::size_t step = 0;; ++step) {
      walk_[step] = here;
      leave(here);
      if (left_ == 0) return;
      const Vertex partner = problem_.partner(here);
      here = is_unvisited(partner) ? partner : choose(here);
    }
  }

  [[nodiscard]] bool is_unvisited(Vertex v) const { return place_in_unvisited_[v] < left_; }

  /// The taboo table: the first left_ of unvisited_ are still allowed.
  void leave(Vertex v) {
    const Vertex place = place_in_unvisited_[v];
    const Vertex last = unvisited_[--left_];
    std::swap(unvisited_[place], unvisited_[left_]);
    place_in_unvisited_[last] = place;
    place_in_unvisited_[v] = static_cast<Vertex>(left_);
  }

  Vertex choose(Vertex here) {
    const auto neighbours = problem_.neighbours(here);
    const double* attraction = attraction_.data() + here * width_;
    double total = 0.0;
    for (std::size_t i = 0; i < width_; ++i) {
      weights_[i] = is_unvisited(neighbours[i]) ? attraction[i] : 0.0;
      total += weights_[i];
    }
    if (!(total > 0.0)) return nearest_unvisited(here);
    double ball = random_.uniform() * total;
    std::size_t chosen = width_;
    for (std::size_t i = 0; i < width_; ++i) {
      if (weights_[i] <= 0.0) continue;
      chosen = i;
      ball -= weights_[i];
      if (ball < 0.0) break;
    }
    return neighbours[chosen];
  }

  [[nodiscard]] Vertex nearest_unvisited(Vertex here) const {
    Vertex nearest = unvisited_[0];
    for (std::size_t i = 1; i < left_; ++i) {
      if (problem_.cost(here, unvisited_[i]) < problem_.cost(here, nearest)) {
        nearest = unvisited_[i];
      }
    }
    return nearest;
  }

  void note(double length) {
    if (length >= round_best_length_) return;
    const bool is_first = age_ == 0;
    round_best_length_ = length;
    round_best_ = iteration_best_;
    since_better_ = 0;
    if (length < best_length_) {
      best_length_ = length;
      best_ = iteration_best_;
    }
    most_trail_ = 1.0 / (config_.rho * round_best_length_);
    least_trail_ = most_trail_ / (2.0 * static_cast<double>(problem_.size()));
    if (is_first) std::ranges::fill(trail_, most_trail_);
  }

  void update_trails(double iteration_length) {
    for (double& trail : trail_) trail = std::max(trail * (1.0 - config_.rho), least_trail_);
    ++age_;
    const std::size_t stage =
        std::min<std::size_t>(static_cast<std::size_t>(age_) / 25, std::size(kBestEvery));
    const int every = stage < std::size(kBestEvery) ? kBestEvery[stage] : 1;
    if (age_ % every == 0) {
      leave_trail(round_best_, 1.0 / round_best_length_);
    } else {
      leave_trail(iteration_best_, 1.0 / iteration_length);
    }
  }

  void leave_trail(const std::vector<Vertex>& tour, double amount) {
    Vertex here = tour.back();
    for (const Vertex next : tour) {
      add_trail(here, next, amount);
      add_trail(next, here, amount);
      here = next;
    }
  }

  void add_trail(Vertex from, Vertex to, double amount) {
    const auto neighbours = problem_.neighbours(from);
    for (std::size_t i = 0; i < width_; ++i) {
      if (neighbours[i] != to) continue;
      double& trail = trail_[from * width_ + i];
      trail = std::min(trail + amount, most_trail_);
      return;
    }
  }

  const TourProblem& problem_;
  const MaxMinConfig& config_;
  RandomStream& random_;
  LocalSearch search_;
  std::size_t width_;
  std::vector<double> heuristic_;  ///< a row of neighbours a vertex, as the two below
  std::vector<double> trail_;
  std::vector<double> attraction_;
  std::vector<Vertex> walk_;
  std::vector<Vertex> iteration_best_;
  std::vector<Vertex> unvisited_;
  std::vector<Vertex> place_in_unvisited_;
  std::vector<double> weights_;
  std::size_t left_ = 0;
  std::vector<Vertex> round_best_;  ///< since the trails began
  double round_best_length_ = std::numeric_limits<double>::infinity();
  std::vector<Vertex> best_;
  double best_length_ = std::numeric_limits<double>::infinity();
  double most_trail_ = 1.0;
  double least_trail_ = 0.0;
  int since_better_ = 0;  ///< iterations
  int age_ = 0;           ///< iterations since the trails began
};

}  // namespace

Tour solve_by_max_min_ants(const CostMatrix& costs, bool closed, const MaxMinConfig& config,
                           RandomStream& random) {
  Tour tour;
  if (costs.size <= 1) return tour;
  const TourProblem problem(costs, closed, static_cast<std::size_t>(config.neighbours));
  tour.order = problem.order(MaxMinAnts(problem, config, random).run());
  tour.cost = tour_cost(costs, tour.order, closed);
  return tour;
}

}  // namespace coop::sequencer
