#include "sweep/navigation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include "core/csv.hpp"
#include "core/markup.hpp"
#include "core/robot/working_range.hpp"
#include "sweep/plot.hpp"

namespace coop::sweep {
namespace {

/// Of the paper's table 1: failures of the first to the fifth navigation of 30 tests.
constexpr std::array<int, 5> kPaperFailures{1, 4, 3, 3, 5};
constexpr int kPaperAttempts = 150;
constexpr int kPaperSuccesses = 134;

struct TestRow {
  int test = 0;
  std::vector<bool> success;
};

struct Attempts {
  std::vector<TestRow> tests;
  std::map<std::string, int> causes;  ///< by their names, failures only
  std::vector<Eigen::Vector2d> hits;
  std::vector<Eigen::Vector2d> misses;
  std::vector<double> distances;            ///< m, egg to working point on arrival
  std::vector<double> localisation_errors;  ///< m, on arrival
  std::vector<double> path_lengths;         ///< m
  int picked = 0;
  int collisions = 0;
  int count = 0;
  int successes = 0;
};

double number(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

void take_row(const CsvTable& table, const std::vector<std::string>& row, TestRow& test,
              Attempts& attempts) {
  const auto field = [&](std::string_view name) { return row[table.column(name)]; };
  attempts.collisions += static_cast<int>(number(field("collisions")));
  if (number(field("try")) > 1) return;
  const bool success = field("in_range") == "1";
  test.success.push_back(success);
  attempts.count += 1;
  attempts.successes += success ? 1 : 0;
  attempts.picked += field("picked") == "1" ? 1 : 0;
  if (!success) attempts.causes[field("cause")] += 1;
  if (field("arrival_time").empty()) return;
  attempts.path_lengths.push_back(number(field("path_length")));
  if (field("distance").empty()) return;
  // Seen from above with the heading upwards, millimetres.
  const Eigen::Vector2d deviation(-1000.0 * number(field("deviation_y")),
                                  1000.0 * number(field("deviation_x")));
  (success ? attempts.hits : attempts.misses).push_back(deviation);
  attempts.distances.push_back(number(field("distance")));
  attempts.localisation_errors.push_back(number(field("localisation_error")));
}

Attempts read(const std::vector<FinishedRun>& runs) {
  Attempts attempts;
  for (const FinishedRun& run : runs) {
    if (!run.result.success) continue;
    TestRow test{run.run.number, {}};
    for (const auto& row : run.table.rows) take_row(run.table, row, test, attempts);
    attempts.tests.push_back(std::move(test));
  }
  return attempts;
}

std::string share_text(int successes, int count) {
  const Estimate share =
      share_of(static_cast<std::size_t>(successes), static_cast<std::size_t>(count));
  return fmt::format("{} of {}, {:.1f} % (95 %: {:.1f} to {:.1f} %)", successes, count,
                     100.0 * share.value, 100.0 * share.low, 100.0 * share.high);
}

/// The paper's table 1: the tests with failures, and the failures in all by place.
std::string table_one(const Attempts& attempts, std::string& csv) {
  std::size_t places = kPaperFailures.size();
  for (const TestRow& test : attempts.tests) places = std::max(places, test.success.size());
  std::vector<std::string> header{"test"};
  for (std::size_t i = 0; i < places; ++i) header.push_back(fmt::format("navigation {}", i + 1));
  csv = csv_line(header);
  std::string rows;
  std::vector<int> failures(places, 0);
  for (const TestRow& test : attempts.tests) {
    std::vector<std::string> fields{std::to_string(test.test)};
    rows += std::ranges::count(test.success, false) > 0
                ? "<tr><td>" + std::to_string(test.test) + "</td>"
                : "";
    const bool shown = std::ranges::count(test.success, false) > 0;
    for (std::size_t i = 0; i < places; ++i) {
      const bool exists = i < test.success.size();
      const bool success = exists && test.success[i];
      fields.emplace_back(!exists ? "" : success ? "T" : "F");
      if (exists && !success) failures[i] += 1;
      if (!shown) continue;
      rows += fmt::format("<td class=\"{}\">{}</td>", success ? "good" : "bad", fields.back());
    }
    if (shown) rows += "</tr>\n";
    csv += csv_line(fields);
  }
  std::string out = "<table>\n<tr>";
  for (const auto& name : header) out += "<th>" + name + "</th>";
  out += "</tr>\n" + rows + "<tr><th>failures</th>";
  for (const int count : failures) out += fmt::format("<td>{}</td>", count);
  out += "</tr>\n<tr><th>failures in the paper</th>";
  for (std::size_t i = 0; i < places; ++i) {
    out += i < kPaperFailures.size() ? fmt::format("<td>{}</td>", kPaperFailures.at(i))
                                     : std::string("<td></td>");
  }
  return out + "</tr>\n</table>\n";
}

std::string summary(const Attempts& attempts) {
  const auto row = [](const std::string& name, const std::string& ours, const std::string& paper) {
    return "<tr><th>" + name + "</th><td>" + ours + "</td><td>" + paper + "</td></tr>\n";
  };
  const auto mean = [](const std::vector<double>& values, double scale, const char* unit) {
    const Estimate e = mean_of(values);
    if (e.count == 0) return std::string("-");
    return fmt::format("{:.1f} {}, worst {:.1f} {}", scale * e.value, unit,
                       scale * *std::ranges::max_element(values), unit);
  };
  return "<table>\n<tr><th></th><th>here</th><th>egg paper</th></tr>\n" +
         row("egg in the working range on arrival", share_text(attempts.successes, attempts.count),
             share_text(kPaperSuccesses, kPaperAttempts)) +
         row("egg picked", share_text(attempts.picked, attempts.count), "not told") +
         row("collisions", std::to_string(attempts.collisions), "not told") +
         row("egg from the working point on arrival, mean", mean(attempts.distances, 1000, "mm"),
             "not told") +
         row("error of localisation on arrival, mean",
             mean(attempts.localisation_errors, 1000, "mm"), "not told") +
         row("driven for an egg, mean", mean(attempts.path_lengths, 1, "m"), "not told") +
         "</table>\n";
}

}  // namespace

std::string render_navigation(const std::vector<Run>& planned, const std::vector<FinishedRun>& runs,
                              std::vector<Page>& pages) {
  const Attempts attempts = read(runs);
  std::string csv;
  const std::string table = table_one(attempts, csv);
  const robot::WorkingRange range;
  ScatterPlot arrivals;
  arrivals.title = "Eggs on arrival, seen from the working point";
  arrivals.x_label = "to the right, mm";
  arrivals.y_label = "ahead, mm";
  arrivals.half_box = {1000.0 * range.across, 1000.0 * range.along};
  arrivals.groups = {{"in range", "#1f5fa8", attempts.hits},
                     {"missed", "#c8501e", attempts.misses}};
  BarPlot causes;
  causes.title = "Failures by cause";
  causes.x_label = "attempts";
  for (const auto& [name, count] : attempts.causes) {
    causes.bars.push_back({name, static_cast<double>(count)});
  }
  std::ranges::sort(causes.bars, std::greater{}, &BarPlot::Bar::value);
  const std::string arrivals_svg = draw(arrivals);
  const std::string causes_svg = draw(causes);
  pages.push_back({"table1.csv", csv});
  pages.push_back({"arrivals.svg", arrivals_svg});
  pages.push_back({"causes.svg", causes_svg});
  return fmt::format(
             "<p>Five eggs at random places within the effective range; an attempt is a goal set "
             "for an egg, successful when the egg lies in the arm's working range ({:.0f} mm "
             "along, "
             "{:.0f} mm across) on arrival. {} tests planned.</p>\n",
             1000.0 * range.along, 1000.0 * range.across, planned.size()) +
         summary(attempts) + "<h2>Table 1: tests with failures</h2>\n" + table +
         "<h2>Arrivals</h2>\n" + arrivals_svg + "<h2>Causes</h2>\n" +
         (causes.bars.empty() ? "<p class=\"good\">No failure.</p>\n" : causes_svg);
}

}  // namespace coop::sweep
