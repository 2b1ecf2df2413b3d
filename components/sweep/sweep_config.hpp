#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/config/fields.hpp"

namespace coop::sweep {

/// One direction of the grid.
struct Axis {
  std::string key;   ///< as for the launcher's --set: component.parameter, variable or launch key
  std::string name;  ///< for people; empty: the key
  std::vector<std::string> values;

  void describe(config::Fields& fields);
  [[nodiscard]] const std::string& label() const { return name.empty() ? key : name; }
};

/// One figure: a column of the table over the grid's first axis, a line for each combination of
/// the other axes' values.
struct Figure {
  std::string name;    ///< of the file: figure_NAME.svg
  std::string title;   ///< empty: the name
  std::string column;  ///< of the table
  /// share: of the rows where the column is 1. mean: over the runs, of each run's mean over its
  /// rows. sum: over the runs, of each run's sum.
  std::string kind = "mean";
  std::string unit;

  void describe(config::Fields& fields);
};

/// How a batch system is asked to make the runs.
struct SlurmSettings {
  std::string partition;   ///< empty: the cluster's default
  std::string time_limit;  ///< of a run, as sbatch's --time; empty: a little over `timeout`
  std::vector<std::string> options;  ///< further ones of sbatch, one word each
  int retries = 2;                   ///< of a run that ended without success

  void describe(config::Fields& fields);
};

/// A launch file over a grid of parameters and seeds.
struct SweepConfig {
  std::string title;
  std::string launch;                  ///< launch file; its runs must end by themselves
  std::string table = "attempts.csv";  ///< what a run leaves in its folder
  std::vector<std::string> settings;   ///< key=value, the same in every run
  std::vector<Axis> grid;              ///< may be empty: one point
  std::int64_t first_seed = 1;
  int seeds = 20;                  ///< runs of each point, with seeds of their own
  double timeout = 1800.0;         ///< s of wall time after which a run has failed
  std::string report = "figures";  ///< or navigation: the egg paper's experiment
  std::vector<Figure> figures;
  SlurmSettings slurm;

  void describe(config::Fields& fields);
  void validate() const;  ///< throws config::Error
};

/// One run to be made.
struct Run {
  int number = 0;  ///< from 1, by point, then seed
  std::size_t point = 0;
  std::int64_t seed = 0;
  std::vector<std::string> values;    ///< one for each axis
  std::vector<std::string> settings;  ///< key=value: the sweep's, then the point's

  /// All that decides the run's result, as text: a run that was made with something else is made
  /// again.
  [[nodiscard]] std::string identity(const SweepConfig& config) const;
  [[nodiscard]] std::string folder_name() const;  ///< 0001, 0002, ...
};

/// All runs; the last axis turns fastest, then the seed.
[[nodiscard]] std::vector<Run> plan_runs(const SweepConfig& config);
[[nodiscard]] std::size_t count_points(const SweepConfig& config);

}  // namespace coop::sweep
