#pragma once
#include <filesystem>
#include <string>

#include "experiments/casma/tables.hpp"

namespace coop::casma {

/// A path to be drawn into a pen.
struct DrawnPath {
  std::string name;
  std::string colour;
  std::vector<Cell> cells;
  bool dashed = false;
};

/// The pen from above as SVG, y upwards: pigs, paths, start and goal.
[[nodiscard]] std::string draw_pen(const std::string& title, int width, int height,
                                   const std::vector<Pig>& pigs,
                                   const std::vector<DrawnPath>& paths);

/// report.html, a CSV file for each table, plans.csv, moving.csv and rosenbrock.csv with every
/// single run, and the figures.
void write_report(const std::filesystem::path& folder, const Findings& findings);

}  // namespace coop::casma
