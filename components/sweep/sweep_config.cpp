#include "sweep/sweep_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/config/error.hpp"

namespace coop::sweep {

void Axis::describe(config::Fields& fields) {
  fields.text("key", key, {.help = "component.parameter, variable or launch key"});
  fields.text("name", name, {.help = "for people; default: the key"});
  fields.texts("values", values, {.help = "what it takes in turn"});
}

void Figure::describe(config::Fields& fields) {
  static constexpr std::array<std::string_view, 3> kKinds{"share", "mean", "sum"};
  fields.text("name", name, {.help = "of the file figure_NAME.svg"});
  fields.text("title", title, {.help = "default: the name"});
  fields.text("column", column, {.help = "of the runs' table"});
  fields.choice("kind", kind, kKinds,
                {.help = "share of rows with 1, or mean over the runs of each run's mean or sum"});
  fields.text("unit", unit, {.help = "for the axis"});
}

void SlurmSettings::describe(config::Fields& fields) {
  fields.text("partition", partition, {.help = "default: the cluster's"});
  fields.text("time_limit", time_limit,
              {.help = "of a run, as sbatch's --time; default: a little over `timeout`"});
  fields.texts("options", options, {.help = "further ones of sbatch, one word each"});
  fields.integer("retries", retries,
                 {.help = "of a run that ended without success", .min = 0, .max = 100});
}

void SweepConfig::describe(config::Fields& fields) {
  static constexpr std::array<std::string_view, 2> kReports{"figures", "navigation"};
  fields.text("title", title, {.help = "of the report"});
  fields.text("launch", launch, {.help = "launch file whose runs end by themselves"});
  fields.text("table", table, {.help = "CSV file that a run leaves in its folder"});
  fields.texts("settings", settings, {.help = "key=value for every run"});
  fields.list("grid", grid);
  fields.integer("first_seed", first_seed, {.help = "seed of each point's first run", .min = 0});
  fields.integer("seeds", seeds, {.help = "runs of each point", .min = 1, .max = 100000});
  fields.number("timeout", timeout,
                {.unit = "s", .help = "of wall time for one run", .min = 1, .max = 1e6});
  fields.choice("report", report, kReports, {.help = "what report.html shows"});
  fields.list("figures", figures);
  fields.section("slurm", slurm);
}

void SweepConfig::validate() const {
  if (launch.empty()) throw config::Error("launch: expected the name of a launch file");
  for (const Axis& axis : grid) {
    if (axis.key.empty()) throw config::Error("grid: expected a key");
    if (axis.values.empty()) throw config::Error("grid: " + axis.key + ": expected values");
  }
  for (const std::string& setting : settings) {
    if (setting.find('=') == std::string::npos) {
      throw config::Error("settings: expected key=value, got '" + setting + "'");
    }
  }
  for (const Figure& figure : figures) {
    if (figure.name.empty() || figure.column.empty()) {
      throw config::Error("figures: expected a name and a column");
    }
    if (figure.name.find('/') != std::string::npos) {
      throw config::Error("figures: '" + figure.name + "' is no part of a file's name");
    }
  }
}

std::string Run::identity(const SweepConfig& config) const {
  std::string text = config.launch + '\n' + std::to_string(seed);
  for (const std::string& setting : settings) text += '\n' + setting;
  return text;
}

std::string Run::folder_name() const {
  return fmt::format("{:04}", number);
}

std::size_t count_points(const SweepConfig& config) {
  std::size_t points = 1;
  for (const Axis& axis : config.grid) points *= axis.values.size();
  return points;
}

std::vector<Run> plan_runs(const SweepConfig& config) {
  std::vector<Run> runs;
  for (std::size_t point = 0; point < count_points(config); ++point) {
    Run run;
    run.point = point;
    run.settings = config.settings;
    std::size_t rest = point;
    for (auto axis = config.grid.rbegin(); axis != config.grid.rend(); ++axis) {
      run.values.push_back(axis->values[rest % axis->values.size()]);
      rest /= axis->values.size();
    }
    std::ranges::reverse(run.values);
    for (std::size_t i = 0; i < config.grid.size(); ++i) {
      run.settings.push_back(config.grid[i].key + "=" + run.values[i]);
    }
    for (int i = 0; i < config.seeds; ++i) {
      run.seed = config.first_seed + i;
      run.number = static_cast<int>(runs.size()) + 1;
      runs.push_back(run);
    }
  }
  return runs;
}

}  // namespace coop::sweep
