// Tables 3, 9 and 10.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/casma/tables.hpp"

namespace coop::casma {
namespace {

double away_from_minimum(const std::vector<double>& place) {
  return std::hypot(place[0] - 1.0, place[1] - 1.0);
}

/// Values of f and distances from (1, 1) of ten places.
struct Spread {
  std::vector<double> values;
  std::vector<double> distances;

  void take(const std::vector<double>& place) {
    values.push_back(rosenbrock(place));
    distances.push_back(away_from_minimum(place));
  }
  [[nodiscard]] static double mean(const std::vector<double>& numbers) {
    double sum = 0.0;
    for (const double number : numbers) sum += number;
    return numbers.empty() ? 0.0 : sum / static_cast<double>(numbers.size());
  }
};

Spread printed_by(const Paper& paper, const std::string& name) {
  Spread spread;
  for (const auto& minima : paper.rosenbrock) {
    if (minima.name != name) continue;
    const std::vector<double>& numbers = minima.value.places;
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
      spread.take({numbers[i], numbers[i + 1]});
    }
  }
  return spread;
}

std::string cell_text(const std::vector<double>& cell) {
  return fmt::format("({:g}, {:g})", cell[0], cell[1]);
}

}  // namespace

Table rosenbrock_table(const Findings& findings) {
  Table table{"table3",
              "Table 3: the Rosenbrock function after 500 iterations, 10 runs",
              "f at the place found, and that place's distance from the minimum (1, 1). The "
              "paper prints places only; f of them is computed here. The box is [-2.048, 2.048]^2.",
              {"swarm", "f median", "f worst", "distance mean", "time, ms", "paper: f median",
               "paper: f worst", "paper: distance mean"},
              {}};
  const std::vector<Searcher> all = searchers();
  for (std::size_t i = 0; i < all.size(); ++i) {
    Spread here;
    std::vector<double> times;
    for (const RosenbrockRun& run : findings.rosenbrock) {
      if (run.searcher != i) continue;
      here.take(run.place);
      times.push_back(run.time_us);
    }
    const bool is_papers = all[i].name == all[i].paper_name;
    const Spread paper = is_papers ? printed_by(findings.paper, all[i].paper_name) : Spread{};
    const auto number = [&](double value) {
      return is_papers ? fmt::format("{:.3g}", value) : std::string("-");
    };
    const auto worst = [](const std::vector<double>& values) {
      return values.empty() ? 0.0 : *std::ranges::max_element(values);
    };
    table.rows.push_back({all[i].name, fmt::format("{:.3g}", median(here.values)),
                          fmt::format("{:.3g}", worst(here.values)),
                          fmt::format("{:.3g}", Spread::mean(here.distances)),
                          fmt::format("{:.2f}", 1e-3 * median(times)), number(median(paper.values)),
                          number(worst(paper.values)), number(Spread::mean(paper.distances))});
  }
  return table;
}

Table rosenbrock_places(const Findings& findings) {
  Table table{"table3_places", "Table 3 run by run: the places found", "", {"run"}, {}};
  const std::vector<Searcher> all = searchers();
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name != all[i].paper_name) continue;
    shown.push_back(i);
    table.header.push_back(all[i].name + " here");
    table.header.push_back(all[i].name + " paper");
  }
  for (std::size_t run = 0; run < kRosenbrockRuns; ++run) {
    std::vector<std::string> row{std::to_string(run + 1)};
    for (const std::size_t i : shown) {
      const std::vector<double>& place = findings.rosenbrock[i * kRosenbrockRuns + run].place;
      row.push_back(fmt::format("{:.5f}, {:.5f}", place[0], place[1]));
      const auto printed = std::ranges::find(findings.paper.rosenbrock, all[i].paper_name,
                                             &config::Named<Minima>::name);
      const bool there =
          printed != findings.paper.rosenbrock.end() && printed->value.places.size() >= 2 * run + 2;
      row.push_back(there ? fmt::format("{:.5f}, {:.5f}", printed->value.places[2 * run],
                                        printed->value.places[2 * run + 1])
                          : "-");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table moving_table(const Findings& findings) {
  Table table{
      "table9",
      "Table 9: moving pigs, a new plan at every step",
      fmt::format(
          "Twelve pigs of map 3's sizes at random places; each walks up to {} cells a tick. "
          "{} trials a map ({} of CASMA paper). Means. Steps: cells moved; waits: ticks in "
          "which there was no way. Paper: mean of its three trials a map.",
          kPigReach, findings.options.seeds,
          (findings.options.seeds + kSlowStride - 1) / kSlowStride),
      {"map", "planner", "arrived", "steps", "waits", "plans", "under a pig", "planning, ms",
       "paper: steps", "paper: planning, ms", "paper / here"},
      {}};
  const std::vector<Contender> all = moving_contenders();
  for (std::size_t map = 0; map < findings.paper.maps.size(); ++map) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      double count = 0, arrived = 0, steps = 0, waits = 0, plans = 0, touched = 0, time = 0;
      for (const MovingRun& run : findings.moving) {
        if (run.map != map || run.contender != i) continue;
        count += 1;
        arrived += run.arrived ? 1 : 0;
        steps += run.steps;
        waits += run.waits;
        plans += run.plans;
        touched += run.touched;
        time += 1e-3 * run.time_us;
      }
      if (count == 0) continue;
      double paper_time = 0.0;
      double paper_steps = 0.0;
      for (const auto& trials : findings.paper.moving) {
        if (trials.name != all[i].paper_name) continue;
        for (std::size_t k = 3 * map; k < 3 * map + 3 && k < trials.value.steps.size(); ++k) {
          paper_time += trials.value.time_ms.at(k) / 3.0;
          paper_steps += trials.value.steps[k] / 3.0;
        }
      }
      const bool in_paper = paper_time > 0.0;
      table.rows.push_back(
          {std::to_string(findings.paper.maps[map].id), all[i].name,
           fmt::format("{:g} of {:g}", arrived, count), fmt::format("{:.1f}", steps / count),
           fmt::format("{:.2f}", waits / count), fmt::format("{:.1f}", plans / count),
           fmt::format("{:g}", touched), fmt::format("{:.3f}", time / count),
           in_paper ? fmt::format("{:.0f}", paper_steps) : "-",
           in_paper ? fmt::format("{:.0f}", paper_time) : "-",
           in_paper ? fmt::format("{:.0f}", paper_time / (time / count)) : "-"});
    }
  }
  return table;
}

Table pilot_table(const Findings& findings) {
  Table table{"table10",
              "Table 10: the pilot pen of 20 x 12 cells",
              "Where the pigs stood is not in the paper: here four pigs of 3 x 3 cells (75 cm) at "
              "random places. Steps are moves, as the paper's are in this table: all five of its "
              "simulated figures equal the Manhattan distance.",
              {"hour", "from", "to", "Manhattan", "steps here (best), mean", "as few as exact",
               "equal to Manhattan", "CASMA paper: found", "its steps, mean", "time, ms",
               "paper: steps", "on the robot", "paper: time, ms"},
              {}};
  for (std::size_t i = 0; i < findings.paper.pilot.size(); ++i) {
    const PilotRun& task = findings.paper.pilot[i];
    const double direct =
        std::abs(task.start[0] - task.goal[0]) + std::abs(task.start[1] - task.goal[1]);
    double count = 0, found = 0, steps = 0, exact = 0, equal = 0, paper_found = 0, paper_steps = 0;
    std::vector<double> times;
    for (const PilotPlan& plan : findings.pilot) {
      if (plan.run != i) continue;
      count += 1;
      times.push_back(plan.time_us);
      exact += plan.steps == plan.fewest ? 1 : 0;
      if (plan.steps > 0) {
        found += 1;
        steps += plan.steps;
        equal += plan.steps == direct ? 1 : 0;
      }
      if (plan.paper_method_steps > 0) {
        paper_found += 1;
        paper_steps += plan.paper_method_steps;
      }
    }
    if (count == 0) continue;
    const auto share = [&](double part) { return fmt::format("{:.1f} %", 100.0 * part / count); };
    table.rows.push_back({std::to_string(task.hour), cell_text(task.start), cell_text(task.goal),
                          fmt::format("{:g}", direct), fmt::format("{:.2f}", steps / found),
                          share(exact), share(equal), share(paper_found),
                          paper_found > 0 ? fmt::format("{:.2f}", paper_steps / paper_found) : "-",
                          fmt::format("{:.4f}", 1e-3 * median(times)), std::to_string(task.steps),
                          std::to_string(task.actual_steps), fmt::format("{:.1f}", task.time_ms)});
  }
  return table;
}

}  // namespace coop::casma
