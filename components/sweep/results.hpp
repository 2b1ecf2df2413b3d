#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/csv.hpp"
#include "sweep/statistics.hpp"
#include "sweep/sweep_config.hpp"

namespace coop::sweep {

/// How a run ended: what result.json in its folder says. The file is written last and as a whole,
/// so where it is, the run is finished.
struct RunResult {
  bool success = false;
  std::string problem;        ///< where it is none
  double wall_seconds = 0.0;  ///< of this run
  std::string identity;       ///< what it was made with
};

[[nodiscard]] std::string to_json(const RunResult& result);
/// Throws std::runtime_error.
[[nodiscard]] RunResult result_from_json(const std::string& text);

/// A run with what it left, where it is finished.
struct FinishedRun {
  Run run;
  RunResult result;
  CsvTable table;  ///< empty where the run had no success
};

/// Files of one run in the sweep's folder.
[[nodiscard]] std::filesystem::path run_folder(const std::filesystem::path& sweep, const Run& run);
[[nodiscard]] std::filesystem::path result_file(const std::filesystem::path& sweep, const Run& run);
[[nodiscard]] std::filesystem::path table_file(const std::filesystem::path& sweep, const Run& run);

/// Is there a result with success of just this run, or must it be made (again)?
[[nodiscard]] bool is_finished(const std::filesystem::path& sweep, const SweepConfig& config,
                               const Run& run);

/// All runs that are finished, in the order of their numbers, those without success too.
[[nodiscard]] std::vector<FinishedRun> gather(const std::filesystem::path& sweep,
                                              const SweepConfig& config,
                                              const std::vector<Run>& runs);

/// One table of all rows: run, a column for each axis, then the runs' own columns. The same runs
/// give the same text, to the bit, however they were made.
[[nodiscard]] std::string all_rows(const SweepConfig& config, const std::vector<FinishedRun>& runs);
/// One row a run: how it ended and what it cost.
[[nodiscard]] std::string run_rows(const SweepConfig& config, const std::vector<FinishedRun>& runs);

/// A figure's estimate at each point of the grid. Throws std::runtime_error where the column is
/// missing or holds no number.
[[nodiscard]] std::vector<Estimate> estimate(const SweepConfig& config, const Figure& figure,
                                             const std::vector<FinishedRun>& runs);
/// One row a point and figure.
[[nodiscard]] std::string point_rows(const SweepConfig& config,
                                     const std::vector<FinishedRun>& runs);

}  // namespace coop::sweep
