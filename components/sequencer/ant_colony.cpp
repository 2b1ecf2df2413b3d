#include "sequencer/ant_colony.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace coop::sequencer {

void AntColonyConfig::describe(config::Fields& fields) {
  fields.integer("ants", ants, {.help = "m of the paper", .min = 1, .max = 10000});
  fields.number("alpha", alpha, {.help = "importance of pheromone", .min = 0, .max = 10});
  fields.number("beta", beta, {.help = "importance of 1 / distance", .min = 0, .max = 10});
  fields.number("rho", rho, {.help = "evaporation an iteration", .min = 0, .max = 1});
  fields.number("q", q, {.unit = "m", .help = "pheromone constant Q", .min = 0, .max = 1e6});
  fields.integer("iterations", iterations, {.help = "t_max", .min = 1, .max = 100000});
  fields.number("initial", initial, {.help = "pheromone at the start", .min = 1e-9, .max = 1e6});
  fields.flag("closed", closed, {.help = "the tour ends where it began"});
}

namespace {

/// Shortest distance that eta = 1 / distance tells apart from none.
constexpr double kShortest = 1e-3;

class Colony {
 public:
  Colony(const CostMatrix& costs, const AntColonyConfig& config, RandomStream& random)
      : costs_(costs),
        config_(config),
        random_(random),
        pheromone_(costs.cost.size(), config.initial),
        deposit_(costs.cost.size()),
        attraction_(costs.cost.size()),
        heuristic_(costs.cost.size()) {
    for (std::size_t i = 0; i < heuristic_.size(); ++i) {
      // No way at all: a heuristic of zero, taken only when nothing else is left.
      heuristic_[i] = std::isfinite(costs.cost[i])
                          ? std::pow(1.0 / std::max(costs.cost[i], kShortest), config.beta)
                          : 0.0;
    }
  }

  Tour run() {
    Tour best;
    best.cost = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < config_.iterations; ++iteration) {
      refresh_attraction();
      std::ranges::fill(deposit_, 0.0);
      for (int ant = 0; ant < config_.ants; ++ant) {
        walk();
        const double length = length_of_walk();
        if (best.order.empty() || length < best.cost) {
          best.order = order_from_start();
          best.cost = length;
        }
        if (std::isfinite(length)) leave_pheromone(length);
      }
      for (std::size_t i = 0; i < pheromone_.size(); ++i) {
        pheromone_[i] = pheromone_[i] * (1.0 - config_.rho) + deposit_[i];  // equation 2
      }
    }
    return best;
  }

 private:
  /// Numerator of equation 1 for every edge: constant within an iteration.
  void refresh_attraction() {
    for (std::size_t i = 0; i < attraction_.size(); ++i) {
      attraction_[i] = std::pow(pheromone_[i], config_.alpha) * heuristic_[i];
    }
  }

  void walk() {
    const std::size_t nodes = costs_.size;
    allowed_.resize(nodes);
    std::iota(allowed_.begin(), allowed_.end(), std::size_t{0});
    walk_.clear();
    const std::size_t start = config_.closed ? random_.below(nodes) : 0;
    move_to(start);
    while (!allowed_.empty()) move_to(choose(walk_.back()));
  }

  /// The taboo table: what was visited is no longer allowed.
  void move_to(std::size_t index_in_allowed) {
    walk_.push_back(allowed_[index_in_allowed]);
    allowed_.erase(allowed_.begin() + static_cast<std::ptrdiff_t>(index_in_allowed));
  }

  /// Roulette wheel over equation 1; answers an index into allowed_.
  std::size_t choose(std::size_t here) {
    const double* row = &attraction_[here * costs_.size];
    double total = 0.0;
    for (const std::size_t node : allowed_) total += row[node];
    if (!(total > 0.0)) return random_.below(allowed_.size());
    double ball = random_.uniform() * total;
    for (std::size_t i = 0; i < allowed_.size(); ++i) {
      ball -= row[allowed_[i]];
      if (ball < 0.0) return i;
    }
    return allowed_.size() - 1;
  }

  [[nodiscard]] double length_of_walk() const {
    double length = 0.0;
    for (std::size_t i = 1; i < walk_.size(); ++i) length += costs_.at(walk_[i - 1], walk_[i]);
    return config_.closed ? length + costs_.at(walk_.back(), walk_.front()) : length;
  }

  /// Equation 3, summed over the ants as equation 2 wants.
  void leave_pheromone(double length) {
    const double amount = config_.q / std::max(length, kShortest);
    for (std::size_t i = 1; i < walk_.size(); ++i) {
      deposit_[walk_[i - 1] * costs_.size + walk_[i]] += amount;
    }
    if (config_.closed) deposit_[walk_.back() * costs_.size + walk_.front()] += amount;
  }

  [[nodiscard]] std::vector<std::size_t> order_from_start() const {
    std::vector<std::size_t> order(walk_);
    std::ranges::rotate(order, std::ranges::find(order, std::size_t{0}));
    order.erase(order.begin());
    return order;
  }

  const CostMatrix& costs_;
  const AntColonyConfig& config_;
  RandomStream& random_;
  std::vector<double> pheromone_;
  std::vector<double> deposit_;
  std::vector<double> attraction_;
  std::vector<double> heuristic_;
  std::vector<std::size_t> allowed_;
  std::vector<std::size_t> walk_;
};

}  // namespace

Tour solve_by_ant_colony(const CostMatrix& costs, const AntColonyConfig& config,
                         RandomStream& random) {
  if (costs.size <= 1) return {};
  return Colony(costs, config, random).run();
}

}  // namespace coop::sequencer
