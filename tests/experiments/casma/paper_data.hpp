#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/fields.hpp"
#include "core/grid.hpp"

namespace coop::casma {

/// A square of size x size cells around a middle cell (the paper's sizes are odd).
struct Pig {
  Cell middle;
  int size = 1;
  bool operator==(const Pig&) const = default;
};

/// A path as table 7 prints it.
struct PublishedPath {
  int steps = 0;
  double time_ms = 0.0;
  std::vector<double> x;
  std::vector<double> y;

  void describe(config::Fields& fields);
  [[nodiscard]] std::vector<Cell> cells() const;
};

/// One of the maps of table 7.
struct PaperMap {
  int id = 0;
  std::vector<double> start;
  std::vector<double> goal;
  std::vector<double> pigs;  ///< x, y, size, one after the other
  std::vector<config::Named<PublishedPath>> published;

  void describe(config::Fields& fields);
  [[nodiscard]] Cell start_cell() const;
  [[nodiscard]] Cell goal_cell() const;
  [[nodiscard]] std::vector<Pig> pig_squares() const;
};

/// Tables 5 and 6.
struct Savings {
  std::vector<double> steps;  ///< percent, a map each
  std::vector<double> time;   ///< percent

  void describe(config::Fields& fields);
};

/// Table 9.
struct MovingTrials {
  std::vector<double> time_ms;
  std::vector<double> steps;
  double mean_time_ms = 0.0;
  double mean_steps = 0.0;

  void describe(config::Fields& fields);
};

/// A column of table 10.
struct PilotRun {
  int hour = 0;
  std::vector<double> start;
  std::vector<double> goal;
  double time_ms = 0.0;
  double actual_time_ms = 0.0;
  int steps = 0;
  int actual_steps = 0;

  void describe(config::Fields& fields);
};

/// Table 3: x1, x2 of each test, one after the other.
struct Minima {
  std::vector<double> places;

  void describe(config::Fields& fields);
};

struct Paper {
  int width = 0;
  int height = 0;
  std::vector<PaperMap> maps;
  std::vector<config::Named<Savings>> savings;
  std::vector<config::Named<Minima>> rosenbrock;
  std::vector<config::Named<MovingTrials>> moving;
  std::vector<PilotRun> pilot;

  void describe(config::Fields& fields);
  /// Throws config::Error where numbers are missing.
  void validate() const;
};

/// Throws config::Error.
[[nodiscard]] Paper load_paper(const std::filesystem::path& file);

}  // namespace coop::casma
