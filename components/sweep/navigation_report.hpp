#pragma once
#include <string>
#include <vector>

#include "sweep/report.hpp"

namespace coop::sweep {

/// The egg paper's section 3 on our runs: its table 1 (the tests with failures, T and F by
/// attempt) beside the paper's totals, the causes, and where the eggs lay on arrival. Adds
/// arrivals.svg, causes.svg and table1.csv to `pages`. A run is a test; of one egg tried more than
/// once the first try counts. Throws std::runtime_error where a table lacks a column.
[[nodiscard]] std::string render_navigation(const std::vector<Run>& planned,
                                            const std::vector<FinishedRun>& runs,
                                            std::vector<Page>& pages);

}  // namespace coop::sweep
