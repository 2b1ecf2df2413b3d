#include "sweep/results.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "core/atomic_file.hpp"

namespace coop::sweep {
namespace {

double number_in(const std::string& text, const std::string& column) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stopped != end) {
    throw std::runtime_error("column '" + column + "' holds '" + text + "', which is no number");
  }
  return value;
}

/// Of one run; empty fields are left out.
std::vector<double> numbers_of(const CsvTable& table, const std::string& column) {
  std::vector<double> values;
  const std::size_t place = table.column(column);
  for (const auto& row : table.rows) {
    if (!row[place].empty()) values.push_back(number_in(row[place], column));
  }
  return values;
}

Estimate estimate_point(const Figure& figure, const std::vector<const FinishedRun*>& runs) {
  std::size_t successes = 0;
  std::size_t rows = 0;
  std::vector<double> by_run;
  for (const FinishedRun* run : runs) {
    const std::vector<double> values = numbers_of(run->table, figure.column);
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    rows += values.size();
    for (const double value : values) successes += value == 1.0 ? 1 : 0;
    if (figure.kind == "sum") by_run.push_back(sum);
    if (figure.kind == "mean" && !values.empty()) {
      by_run.push_back(sum / static_cast<double>(values.size()));
    }
  }
  return figure.kind == "share" ? share_of(successes, rows) : mean_of(by_run);
}

std::vector<std::string> axis_labels(const SweepConfig& config) {
  std::vector<std::string> labels;
  for (const Axis& axis : config.grid) labels.push_back(axis.label());
  return labels;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& what) {
  to.insert(to.end(), what.begin(), what.end());
}

}  // namespace

std::string to_json(const RunResult& result) {
  const nlohmann::ordered_json document{{"success", result.success},
                                        {"problem", result.problem},
                                        {"wall_seconds", result.wall_seconds},
                                        {"identity", result.identity}};
  return document.dump(2) + "\n";
}

RunResult result_from_json(const std::string& text) {
  try {
    const auto document = nlohmann::json::parse(text);
    return {.success = document.at("success").get<bool>(),
            .problem = document.at("problem").get<std::string>(),
            .wall_seconds = document.at("wall_seconds").get<double>(),
            .identity = document.at("identity").get<std::string>()};
  } catch (const nlohmann::json::exception& problem) {
    throw std::runtime_error(problem.what());
  }
}

std::filesystem::path run_folder(const std::filesystem::path& sweep, const Run& run) {
  return sweep / "runs" / run.folder_name();
}

std::filesystem::path result_file(const std::filesystem::path& sweep, const Run& run) {
  return run_folder(sweep, run) / "result.json";
}

std::filesystem::path table_file(const std::filesystem::path& sweep, const Run& run) {
  return run_folder(sweep, run) / "table.csv";
}

bool is_finished(const std::filesystem::path& sweep, const SweepConfig& config, const Run& run) {
  if (!std::filesystem::exists(result_file(sweep, run))) return false;
  const RunResult result = result_from_json(read_file(result_file(sweep, run)));
  return result.success && result.identity == run.identity(config);
}

std::vector<FinishedRun> gather(const std::filesystem::path& sweep, const SweepConfig& config,
                                const std::vector<Run>& runs) {
  std::vector<FinishedRun> finished;
  for (const Run& run : runs) {
    if (!std::filesystem::exists(result_file(sweep, run))) continue;
    FinishedRun one{run, result_from_json(read_file(result_file(sweep, run))), {}};
    if (one.result.identity != run.identity(config)) continue;
    if (one.result.success) one.table = parse_csv(read_file(table_file(sweep, run)));
    finished.push_back(std::move(one));
  }
  return finished;
}

std::string all_rows(const SweepConfig& config, const std::vector<FinishedRun>& runs) {
  std::string out;
  for (const FinishedRun& run : runs) {
    if (!run.result.success) continue;
    if (out.empty()) {
      std::vector<std::string> header{"run"};
      append(header, axis_labels(config));
      append(header, run.table.columns);
      out = csv_line(header);
    }
    for (const auto& row : run.table.rows) {
      std::vector<std::string> fields{std::to_string(run.run.number)};
      append(fields, run.run.values);
      append(fields, row);
      out += csv_line(fields);
    }
  }
  return out;
}

std::string run_rows(const SweepConfig& config, const std::vector<FinishedRun>& runs) {
  std::vector<std::string> header{"run"};
  append(header, axis_labels(config));
  append(header, {"seed", "success", "wall_seconds", "problem"});
  std::string out = csv_line(header);
  for (const FinishedRun& run : runs) {
    std::vector<std::string> fields{std::to_string(run.run.number)};
    append(fields, run.run.values);
    append(fields, {std::to_string(run.run.seed), run.result.success ? "1" : "0",
                    fmt::format("{:.1f}", run.result.wall_seconds), run.result.problem});
    out += csv_line(fields);
  }
  return out;
}

std::vector<Estimate> estimate(const SweepConfig& config, const Figure& figure,
                               const std::vector<FinishedRun>& runs) {
  std::vector<std::vector<const FinishedRun*>> by_point(count_points(config));
  for (const FinishedRun& run : runs) {
    if (run.result.success) by_point[run.run.point].push_back(&run);
  }
  std::vector<Estimate> estimates;
  estimates.reserve(by_point.size());
  for (const auto& point : by_point) estimates.push_back(estimate_point(figure, point));
  return estimates;
}

std::string point_rows(const SweepConfig& config, const std::vector<FinishedRun>& runs) {
  std::vector<std::string> header{"figure"};
  append(header, axis_labels(config));
  append(header, {"value", "low", "high", "count"});
  std::string out = csv_line(header);
  SweepConfig one_each = config;
  one_each.seeds = 1;
  const std::vector<Run> points = plan_runs(one_each);
  for (const Figure& figure : config.figures) {
    const std::vector<Estimate> estimates = estimate(config, figure, runs);
    for (std::size_t i = 0; i < estimates.size(); ++i) {
      const Estimate& e = estimates[i];
      std::vector<std::string> fields{figure.name};
      append(fields, points[i].values);
      append(fields, {fmt::format("{:.6g}", e.value), fmt::format("{:.6g}", e.low),
                      fmt::format("{:.6g}", e.high), std::to_string(e.count)});
      out += csv_line(fields);
    }
  }
  return out;
}

}  // namespace coop::sweep
