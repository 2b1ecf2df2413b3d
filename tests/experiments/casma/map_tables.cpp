// Tables 5, 6 and 7.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "experiments/casma/tables.hpp"

namespace coop::casma {
namespace {

int fewest_on(const Findings& findings, std::size_t map) {
  const PaperMap& place = findings.paper.maps[map];
  return fewest_cells(pen_with(findings.paper.width, findings.paper.height, place.pig_squares()),
                      place.start_cell(), place.goal_cell());
}

const PublishedPath* published_by(const PaperMap& map, const std::string& name) {
  const auto found = std::ranges::find(map.published, name, &config::Named<PublishedPath>::name);
  return found == map.published.end() ? nullptr : &found->value;
}

std::string verdict(const PathCheck& check, int printed_steps) {
  std::vector<std::string> faults;
  if (check.pig_cells > 0) faults.push_back(fmt::format("{} cells under pigs", check.pig_cells));
  if (check.jumps > 0) faults.push_back(fmt::format("{} jumps", check.jumps));
  if (!check.at_goal) faults.emplace_back("does not end at the goal");
  if (check.repeats > 0) faults.push_back(fmt::format("repeats {} cell", check.repeats));
  if (check.cells != printed_steps) {
    faults.push_back(fmt::format("{} cells, {} printed", check.cells, printed_steps));
  }
  std::string out;
  for (const std::string& fault : faults) out += (out.empty() ? "" : "; ") + fault;
  return out.empty() ? "sound" : out;
}

std::string saving(double ours, double other) {
  return other > 0.0 ? fmt::format("{:.2f}", 100.0 * (other - ours) / other) : "-";
}

}  // namespace

PlanSummary summarise(const Findings& findings, std::size_t map, std::size_t contender) {
  const int optimum = fewest_on(findings, map);
  PlanSummary summary;
  summary.fewest = std::numeric_limits<int>::max();
  std::vector<double> cells;
  std::vector<double> times;
  for (const PlanRun& run : findings.plans) {
    if (run.map != map || run.contender != contender) continue;
    ++summary.seeds;
    times.push_back(run.time_us);
    if (!run.found || !run.check.sound()) continue;
    ++summary.sound;
    if (run.check.cells == optimum) ++summary.optimal;
    cells.push_back(run.check.cells);
    summary.fewest = std::min(summary.fewest, run.check.cells);
    summary.most = std::max(summary.most, run.check.cells);
    summary.mean += run.check.cells;
    summary.turns += run.turns;
  }
  if (summary.sound == 0) summary.fewest = 0;
  if (summary.sound > 0) {
    summary.mean /= summary.sound;
    summary.turns /= summary.sound;
  }
  summary.median = median(cells);
  summary.time_us = median(times);
  return summary;
}

Table published_table(const Findings& findings) {
  Table table{"table7_published",
              "Table 7 as printed, checked",
              "A path's steps are its cells, both ends counted. A path that touches a pig has "
              "failed.",
              {"map", "by", "steps printed", "cells", "fewest", "verdict"},
              {}};
  for (std::size_t i = 0; i < findings.paper.maps.size(); ++i) {
    const PaperMap& map = findings.paper.maps[i];
    const auto pen = pen_with(findings.paper.width, findings.paper.height, map.pig_squares());
    for (const auto& path : map.published) {
      const PathCheck check =
          check_path(path.value.cells(), pen, map.start_cell(), map.goal_cell());
      table.rows.push_back({std::to_string(map.id), path.name, std::to_string(path.value.steps),
                            std::to_string(check.cells), std::to_string(fewest_on(findings, i)),
                            verdict(check, path.value.steps)});
    }
  }
  return table;
}

Table plans_table(const Findings& findings) {
  Table table{"table7",
              "Table 7 repeated: steps and time",
              fmt::format("{} seeds; steps are cells; time: median of a fresh planner's first "
                          "plan, processor time of one core.",
                          findings.options.seeds),
              {"map", "planner", "without a collision", "optimal", "steps min", "median", "max",
               "turns", "time, ms", "paper: steps", "paper: time, ms", "paper / here"},
              {}};
  const std::vector<Contender> all = contenders();
  for (std::size_t map = 0; map < findings.paper.maps.size(); ++map) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const PlanSummary s = summarise(findings, map, i);
      const PublishedPath* paper = published_by(findings.paper.maps[map], all[i].paper_name);
      const auto share = [&](int count) {
        return fmt::format("{:.1f} %", s.seeds > 0 ? 100.0 * count / s.seeds : 0.0);
      };
      const auto steps = [&](double value) {
        return s.sound > 0 ? fmt::format("{:g}", value) : std::string("-");
      };
      table.rows.push_back(
          {std::to_string(findings.paper.maps[map].id), all[i].name, share(s.sound),
           share(s.optimal), steps(s.fewest), steps(s.median), steps(s.most),
           s.sound > 0 ? fmt::format("{:.1f}", s.turns) : "-",
           fmt::format("{:.4f}", 1e-3 * s.time_us),
           paper != nullptr ? std::to_string(paper->steps) : "-",
           paper != nullptr ? fmt::format("{:.1f}", paper->time_ms) : "-",
           paper != nullptr ? fmt::format("{:.0f}", 1e3 * paper->time_ms / s.time_us) : "-"});
    }
  }
  return table;
}

Table savings_table(const Findings& findings) {
  Table table{"table5_6",
              "Tables 5 and 6: what CASMA saves, percent",
              "Here: CASMA best against the planner of the column's name, mean steps of sound "
              "paths and median time. Recomputed: the paper's percentages from its own table 7.",
              {"map", "against", "steps here", "steps paper", "recomputed", "time here",
               "time paper", "recomputed"},
              {}};
  const std::vector<Contender> all = contenders();
  for (std::size_t map = 0; map < findings.paper.maps.size(); ++map) {
    const PaperMap& place = findings.paper.maps[map];
    const PlanSummary best = summarise(findings, map, 0);
    const PublishedPath* casma = published_by(place, "CASMA");
    for (const auto& savings : findings.paper.savings) {
      const PublishedPath* other = published_by(place, savings.name);
      const auto rival = std::ranges::find(all, savings.name, &Contender::name);
      if (casma == nullptr || other == nullptr || rival == all.end()) continue;
      const PlanSummary theirs =
          summarise(findings, map, static_cast<std::size_t>(rival - all.begin()));
      table.rows.push_back(
          {std::to_string(place.id), savings.name, saving(best.mean, theirs.mean),
           fmt::format("{:.2f}", savings.value.steps[map]), saving(casma->steps, other->steps),
           saving(best.time_us, theirs.time_us), fmt::format("{:.2f}", savings.value.time[map]),
           saving(casma->time_ms, other->time_ms)});
    }
  }
  return table;
}

}  // namespace coop::casma
