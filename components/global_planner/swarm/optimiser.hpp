#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/config/fields.hpp"
#include "core/random.hpp"

namespace coop::global_planner::swarm {

/// Something to be made small over a box.
class Objective {
 public:
  virtual ~Objective() = default;
  /// One for each dimension.
  [[nodiscard]] virtual std::span<const double> lower() const = 0;
  [[nodiscard]] virtual std::span<const double> upper() const = 0;
  [[nodiscard]] virtual double operator()(std::span<const double> place) = 0;
};

struct Minimum {
  std::vector<double> place;
  double value = 0.0;
};

/// A population that looks for the lowest place of a box. The best place ever met is kept, whatever
/// becomes of the population.
class Optimiser {
 public:
  virtual ~Optimiser() = default;
  /// `course`, where given, receives the best value so far after every iteration.
  virtual Minimum minimise(Objective& objective, RandomStream& random,
                           std::vector<double>* course = nullptr) = 0;
};

/// How many and how long; the same for all (table 8).
struct PopulationConfig {
  int population = 100;
  int iterations = 500;

  void describe(config::Fields& fields);
};

/// Places of a population, one after the other, with their values and the best ever.
class Population {
 public:
  /// Scattered evenly over the box.
  Population(Objective& objective, int size, RandomStream& random);

  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] std::size_t dimensions() const { return lower_.size(); }
  [[nodiscard]] std::span<double> at(std::size_t i) {
    return {places_.data() + i * dimensions(), dimensions()};
  }
  [[nodiscard]] double value(std::size_t i) const { return values_[i]; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  [[nodiscard]] double low(std::size_t d) const { return lower_[d]; }
  [[nodiscard]] double span(std::size_t d) const { return upper_[d] - lower_[d]; }
  [[nodiscard]] const Minimum& best() const { return best_; }

  /// The value of a place, moved into the box first.
  double judge(std::span<double> place);
  /// Judges the individual where it is now.
  void judge(std::size_t i) { values_[i] = judge(at(i)); }
  /// Puts the individual at a place already judged.
  void move(std::size_t i, std::span<const double> place, double value);

 private:
  Objective* objective_;
  std::span<const double> lower_;
  std::span<const double> upper_;
  std::vector<double> places_;
  std::vector<double> values_;
  Minimum best_;
};

}  // namespace coop::global_planner::swarm
