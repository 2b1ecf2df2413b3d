#include "sweep/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/atomic_file.hpp"
#include "core/markup.hpp"
#include "sweep/navigation_report.hpp"
#include "sweep/plot.hpp"

namespace coop::sweep {
namespace {

/// A figure's estimates, ordered for drawing: the first axis along x, a line for each combination
/// of the others.
LinePlot plot_of(const SweepConfig& config, const Figure& figure,
                 const std::vector<Estimate>& estimates) {
  LinePlot plot;
  plot.title = figure.title.empty() ? figure.name : figure.title;
  plot.y_label = figure.column + (figure.unit.empty() ? "" : ", " + figure.unit);
  if (config.grid.empty()) {
    plot.places = {""};
    plot.series = {{"", estimates}};
    return plot;
  }
  plot.x_label = config.grid.front().label();
  plot.places = config.grid.front().values;
  const std::size_t lines = estimates.size() / plot.places.size();
  SweepConfig one_each = config;
  one_each.seeds = 1;
  const std::vector<Run> points = plan_runs(one_each);
  for (std::size_t line = 0; line < lines; ++line) {
    Series series;
    for (std::size_t axis = 1; axis < config.grid.size(); ++axis) {
      if (!series.name.empty()) series.name += ", ";
      series.name += config.grid[axis].label() + " " + points[line].values[axis];
    }
    for (std::size_t place = 0; place < plot.places.size(); ++place) {
      series.values.push_back(estimates[place * lines + line]);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

std::string problems(const std::vector<FinishedRun>& runs) {
  std::string list;
  for (const FinishedRun& run : runs) {
    if (run.result.success) continue;
    list += fmt::format("<li>run {}, seed {}: {}</li>\n", run.run.number, run.run.seed,
                        escape_markup(run.result.problem));
  }
  if (list.empty()) return {};
  return "<p class=\"bad\">Runs without a result, which the next call makes again:</p>\n<ul>" +
         list + "</ul>\n";
}

std::string table_of(const std::string& csv) {
  const CsvTable table = parse_csv(csv);
  return html_table(table.columns, table.rows);
}

}  // namespace

Effort effort_of(std::size_t planned, const std::vector<FinishedRun>& runs) {
  Effort effort{.planned = planned, .simulated_seconds = 0.0, .wall_seconds = 0.0};
  for (const FinishedRun& run : runs) {
    effort.wall_seconds += run.result.wall_seconds;
    const auto column = std::ranges::find(run.table.columns, "end_time");
    if (column == run.table.columns.end()) continue;
    double last = 0.0;
    for (const auto& row : run.table.rows) {
      const std::string& text = row[static_cast<std::size_t>(column - run.table.columns.begin())];
      double end = 0.0;
      std::from_chars(text.data(), text.data() + text.size(), end);
      last = std::max(last, end);
    }
    effort.simulated_seconds += last;
  }
  return effort;
}

std::string render(const Effort& effort, const std::vector<FinishedRun>& runs) {
  const auto good =
      std::ranges::count_if(runs, [](const FinishedRun& run) { return run.result.success; });
  std::string out = fmt::format("<p>{} of {} runs, {:.0f} s of wall time in all", good,
                                effort.planned, effort.wall_seconds);
  if (effort.simulated_seconds > 0.0 && effort.wall_seconds > 0.0) {
    out += fmt::format(", {:.0f} s simulated: {:.2f} times real time a run",
                       effort.simulated_seconds, effort.simulated_seconds / effort.wall_seconds);
  }
  return out + ".</p>\n" + problems(runs);
}

std::vector<Page> render_sweep(const SweepConfig& config, const std::vector<Run>& planned,
                               const std::vector<FinishedRun>& runs) {
  const std::string points = point_rows(config, runs);
  std::vector<Page> pages{{"all.csv", all_rows(config, runs)},
                          {"runs.csv", run_rows(config, runs)},
                          {"points.csv", points}};
  std::string body = "<h1>" + escape_markup(config.title) + "</h1>\n" +
                     render(effort_of(planned.size(), runs), runs);
  if (config.report == "navigation") body += render_navigation(planned, runs, pages);
  std::string figures;
  for (const Figure& figure : config.figures) {
    const std::string svg = draw(plot_of(config, figure, estimate(config, figure, runs)));
    pages.push_back({"figure_" + figure.name + ".svg", svg});
    if (!config.grid.empty()) figures += svg;
  }
  if (!figures.empty()) {
    body +=
        "<h2>Figures</h2>\n<p>Intervals: 95 %, of shares by Wilson over all rows, of means by "
        "Student's t over the runs.</p>\n" +
        figures;
  }
  if (!config.figures.empty()) body += "<h2>Points</h2>\n" + table_of(points);
  pages.push_back({"report.html", html_page(config.title, body)});
  return pages;
}

void write_pages(const std::filesystem::path& folder, const std::vector<Page>& pages) {
  for (const Page& page : pages) write_file_atomically(folder / page.name, page.content);
}

}  // namespace coop::sweep
