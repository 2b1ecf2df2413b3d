#pragma once
#include <string>
#include <vector>

#include "experiments/casma/stages.hpp"

namespace coop::casma {

/// What the experiment has found, in the order it was found.
struct Findings {
  Paper paper;
  StageOptions options;
  std::vector<RosenbrockRun> rosenbrock;
  std::vector<PlanRun> plans;
  std::vector<MovingRun> moving;
  std::vector<PilotPlan> pilot;
};

struct Table {
  std::string name;  ///< of its CSV file
  std::string title;
  std::string note;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

[[nodiscard]] std::string as_text(const Table& table);
[[nodiscard]] std::string as_html(const Table& table);
[[nodiscard]] std::string as_csv(const Table& table);

/// Plans of one contender on one map in figures.
struct PlanSummary {
  int seeds = 0;
  int sound = 0;    ///< seeds with a path from start to goal that touches no pig
  int optimal = 0;  ///< of these, with the fewest cells
  int fewest = 0;   ///< cells of the shortest sound path found; 0: none was
  double median = 0.0;
  int most = 0;
  double mean = 0.0;
  double turns = 0.0;    ///< mean
  double time_us = 0.0;  ///< median
};
[[nodiscard]] PlanSummary summarise(const Findings& findings, std::size_t map,
                                    std::size_t contender);
/// 0 of none.
[[nodiscard]] double median(std::vector<double> values);

[[nodiscard]] Table rosenbrock_table(const Findings& findings);
[[nodiscard]] Table rosenbrock_places(const Findings& findings);
[[nodiscard]] Table published_table(const Findings& findings);
[[nodiscard]] Table plans_table(const Findings& findings);
[[nodiscard]] Table savings_table(const Findings& findings);
[[nodiscard]] Table moving_table(const Findings& findings);
[[nodiscard]] Table pilot_table(const Findings& findings);
[[nodiscard]] std::vector<Table> all_tables(const Findings& findings);

}  // namespace coop::casma
