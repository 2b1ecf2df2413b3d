#include "experiments/casma/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "core/markup.hpp"
#include "sweep/plot.hpp"
#include "sweep/statistics.hpp"

namespace coop::casma {
namespace {

struct Figure {
  std::string name;
  std::string svg;
};

/// Figure 6: the best value after each iteration, median of ten runs, as power of ten.
Figure convergence(const Findings& findings) {
  sweep::LinePlot plot;
  plot.title = "Rosenbrock: best value so far, median of ten runs";
  plot.x_label = "iteration";
  plot.y_label = "log10 f";
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i <= 500; i += 50) places.push_back(std::max<std::size_t>(1, i));
  for (const std::size_t place : places) plot.places.push_back(std::to_string(place));
  const std::vector<Searcher> all = searchers();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name != all[i].paper_name) continue;
    sweep::Series series{all[i].name, {}};
    for (const std::size_t place : places) {
      std::vector<double> values;
      for (const RosenbrockRun& run : findings.rosenbrock) {
        if (run.searcher == i) values.push_back(run.course.at(place - 1));
      }
      // Zero has no logarithm; far below what an axis should show.
      const double shown = std::log10(std::max(median(values), 1e-12));
      series.values.push_back({shown, shown, shown, values.size()});
    }
    plot.series.push_back(std::move(series));
  }
  return {"figure6_convergence", sweep::draw(plot)};
}

const PlanRun* first_plan(const Findings& findings, std::size_t map, const std::string& name) {
  const std::vector<Contender> all = contenders();
  const auto run = std::ranges::find_if(findings.plans, [&](const PlanRun& plan) {
    return plan.map == map && all[plan.contender].name == name && plan.found;
  });
  return run == findings.plans.end() ? nullptr : &*run;
}

/// Figures 7 to 9: the first seed's paths and two of the paper's.
Figure pen_figure(const Findings& findings, std::size_t map) {
  const PaperMap& place = findings.paper.maps[map];
  std::vector<DrawnPath> paths;
  const auto add = [&](const std::string& name, const std::string& colour) {
    const PlanRun* run = first_plan(findings, map, name);
    if (run != nullptr) paths.push_back({name, colour, run->path, false});
  };
  add("CASMA best", "#1f5fa8");
  add("CASMA paper", "#8a3a9a");
  add("ACO", "#2a8a4a");
  add("A*", "#555555");
  for (const auto& printed : place.published) {
    if (printed.name == "CASMA") {
      paths.push_back({"CASMA, as published", "#b08a00", printed.value.cells(), true});
    }
    if (printed.name == "ACO") {
      paths.push_back({"ACO, as published", "#c8501e", printed.value.cells(), true});
    }
  }
  return {fmt::format("figure{}_map{}", 7 + map, place.id),
          draw_pen(fmt::format("Map {}: paths of the first seed", place.id), findings.paper.width,
                   findings.paper.height, place.pig_squares(), paths)};
}

Figure optimum_shares(const Findings& findings) {
  sweep::BarPlot plot;
  plot.title = "Seeds with the fewest steps, all three maps";
  plot.x_label = "percent of the seeds";
  const std::vector<Contender> all = contenders();
  for (std::size_t i = 0; i < all.size(); ++i) {
    double optimal = 0;
    double seeds = 0;
    for (std::size_t map = 0; map < findings.paper.maps.size(); ++map) {
      const PlanSummary summary = summarise(findings, map, i);
      optimal += summary.optimal;
      seeds += summary.seeds;
    }
    plot.bars.push_back({all[i].name, std::round(1000.0 * optimal / seeds) / 10.0});
  }
  return {"optimum_shares", sweep::draw(plot)};
}

/// As figure 13, over all maps.
Figure moving_steps(const Findings& findings) {
  sweep::LinePlot plot;
  plot.title = "Moving pigs: steps of a trial, mean";
  plot.x_label = "map";
  plot.y_label = "cells moved";
  for (const PaperMap& map : findings.paper.maps) plot.places.push_back(std::to_string(map.id));
  const std::vector<Contender> all = moving_contenders();
  for (std::size_t i = 0; i < all.size(); ++i) {
    sweep::Series series{all[i].name, {}};
    for (std::size_t map = 0; map < findings.paper.maps.size(); ++map) {
      std::vector<double> steps;
      for (const MovingRun& run : findings.moving) {
        if (run.map == map && run.contender == i && run.arrived) steps.push_back(run.steps);
      }
      series.values.push_back(sweep::mean_of(steps));
    }
    plot.series.push_back(std::move(series));
  }
  return {"figure13_moving", sweep::draw(plot)};
}

std::string plans_csv(const Findings& findings) {
  const std::vector<Contender> all = contenders();
  std::string out = csv_line(
      {"map", "planner", "seed", "found", "sound", "cells", "pig_cells", "turns", "time_us"});
  for (const PlanRun& run : findings.plans) {
    out += csv_line({std::to_string(findings.paper.maps[run.map].id), all[run.contender].name,
                     std::to_string(run.seed), run.found ? "1" : "0",
                     run.found && run.check.sound() ? "1" : "0", std::to_string(run.check.cells),
                     std::to_string(run.check.pig_cells), std::to_string(run.turns),
                     fmt::format("{:.3f}", run.time_us)});
  }
  return out;
}

std::string moving_csv(const Findings& findings) {
  const std::vector<Contender> all = moving_contenders();
  std::string out = csv_line({"map", "planner", "seed", "arrived", "steps", "waits", "plans",
                              "under_a_pig", "planning_us"});
  for (const MovingRun& run : findings.moving) {
    out += csv_line({std::to_string(findings.paper.maps[run.map].id), all[run.contender].name,
                     std::to_string(run.seed), run.arrived ? "1" : "0", std::to_string(run.steps),
                     std::to_string(run.waits), std::to_string(run.plans),
                     std::to_string(run.touched), fmt::format("{:.3f}", run.time_us)});
  }
  return out;
}

std::string rosenbrock_csv(const Findings& findings) {
  const std::vector<Searcher> all = searchers();
  std::string out = csv_line({"swarm", "run", "iteration", "best"});
  for (std::size_t i = 0; i < findings.rosenbrock.size(); ++i) {
    const RosenbrockRun& run = findings.rosenbrock[i];
    for (std::size_t k = 0; k < run.course.size(); ++k) {
      out += csv_line({all[run.searcher].name, std::to_string(i % kRosenbrockRuns + 1),
                       std::to_string(k + 1), fmt::format("{:.9g}", run.course[k])});
    }
  }
  return out;
}

/// What the tables say, from their own numbers.
std::string verdict(const Findings& findings) {
  const std::vector<Contender> all = contenders();
  std::string out = "<ul>\n";
  const auto line = [&](const std::string& name, const std::string& words) {
    const auto place =
        static_cast<std::size_t>(std::ranges::find(all, name, &Contender::name) - all.begin());
    int optimal = 0, sound = 0, seeds = 0;
    double time = 0.0;
    for (std::size_t map = 0; map < findings.paper.maps.size(); ++map) {
      const PlanSummary s = summarise(findings, map, place);
      optimal += s.optimal;
      sound += s.sound;
      seeds += s.seeds;
      time = std::max(time, s.time_us);
    }
    out += fmt::format(
        "<li><b>{}</b>: the fewest steps in {} of {} plans, a path without collision in {}; at "
        "most "
        "{:.3f} ms (median of the slowest map). {}</li>\n",
        name, optimal, seeds, sound, 1e-3 * time, words);
  };
  line("A*", "Exact on any map, and the fastest of those that are.");
  line("CASMA best", "Exact on any map too, for its cellular automaton is a wave search.");
  line("CASMA paper", "The equations, repaired only as far as they must be to mean anything.");
  line("CASMA paper, turned",
       "The same on the maps turned by 180 degrees: how well it does depends on where the origin "
       "of the coordinates lies, for equation 7 pulls towards it.");
  line("CASMA printed", "Equations 6 and 7 to the letter draw every mould into a corner.");
  line("coin", "A coin tossed between the two directions that lead nearer: the maps are easy.");
  return out + "</ul>\n";
}

}  // namespace

void write_report(const std::filesystem::path& folder, const Findings& findings) {
  std::vector<Figure> figures{convergence(findings)};
  for (std::size_t map = 0; map < findings.paper.maps.size(); ++map) {
    figures.push_back(pen_figure(findings, map));
  }
  figures.push_back(optimum_shares(findings));
  figures.push_back(moving_steps(findings));
  const std::vector<Table> tables = all_tables(findings);
  std::string body = fmt::format(
      "<h1>The CASMA paper repeated</h1>\n<p>{} seeds from {} on. A path's steps on the maps are "
      "its cells, as in the paper; a path that touches a pig has failed. Times are processor time "
      "of one core here, of Python on a laptop in the paper.</p>\n<h2>Who wins</h2>\n",
      findings.options.seeds, findings.options.first_seed);
  body += verdict(findings) + "<h2>Tables</h2>\n";
  for (const Table& table : tables) {
    body += as_html(table);
    write_file_atomically(folder / (table.name + ".csv"), as_csv(table));
  }
  body += "<h2>Figures</h2>\n";
  for (const Figure& figure : figures) {
    body += figure.svg;
    write_file_atomically(folder / (figure.name + ".svg"), figure.svg);
  }
  write_file_atomically(folder / "plans.csv", plans_csv(findings));
  write_file_atomically(folder / "moving.csv", moving_csv(findings));
  write_file_atomically(folder / "rosenbrock.csv", rosenbrock_csv(findings));
  write_file_atomically(folder / "report.html", html_page("The CASMA paper repeated", body));
}

}  // namespace coop::casma
