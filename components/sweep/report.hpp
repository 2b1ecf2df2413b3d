#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sweep/results.hpp"

namespace coop::sweep {

/// A file of the sweep's results.
struct Page {
  std::string name;
  std::string content;
};

/// What the time was spent on.
struct Effort {
  std::size_t planned = 0;         ///< runs
  double simulated_seconds = 0.0;  ///< of all finished runs, as far as their tables tell (end_time)
  double wall_seconds = 0.0;       ///< of all finished runs, one after the other
};
[[nodiscard]] Effort effort_of(std::size_t planned, const std::vector<FinishedRun>& runs);
/// A paragraph of HTML.
[[nodiscard]] std::string render(const Effort& effort, const std::vector<FinishedRun>& runs);

/// all.csv, runs.csv, points.csv, a figure_NAME.svg for each figure, report.html: of as many runs
/// as are finished.
[[nodiscard]] std::vector<Page> render_sweep(const SweepConfig& config,
                                             const std::vector<Run>& planned,
                                             const std::vector<FinishedRun>& runs);

/// Writes them into the folder, each atomically.
void write_pages(const std::filesystem::path& folder, const std::vector<Page>& pages);

}  // namespace coop::sweep
