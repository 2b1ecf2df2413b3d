// Missions of the whole robot while its programs die, hang, are slow, lose packets, are cut off,
// hear a wrong time and find the disk full; judged by the truth of the simulated world.
//   chaos_experiment --faults 200 --seed 1 -o DIR
#include <CLI/CLI.hpp>
#include <iostream>

#include "core/atomic_file.hpp"
#include "experiments/chaos/chaos.hpp"

int main(int argc, char** argv) {
  coop::chaos::ChaosOptions options;
  CLI::App app{"missions with faults, judged by the truth of the simulated world"};
  app.add_option("--faults", options.faults, "how many")->check(CLI::Range(1, 100000));
  app.add_option("--seed", options.seed, "of faults and worlds");
  app.add_option("--gap", options.gap, "s of simulated time between two faults, on average")
      ->check(CLI::Range(1.0, 1000.0));
  app.add_option("--rate", options.rate, "of simulated time")->check(CLI::Range(0.1, 20.0));
  app.add_option("--components", options.components, "who is hit: these alone")
      ->check(CLI::IsMember(options.components));
  app.add_option("--set", options.settings, "a setting for the launcher, as in coop up");
  app.add_option("-o,--output", options.out,
                 "folder for faults.csv, report.md and logs of what went wrong");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!options.out.empty()) {
      options.out = std::filesystem::absolute(options.out);
      std::filesystem::create_directories(options.out);
    }
    const auto result = coop::chaos::run_chaos(options, std::cout);
    const std::string report = coop::chaos::report_of(options, result);
    std::cout << report;
    if (!options.out.empty()) {
      coop::write_file_atomically(options.out / "report.md", report);
      coop::write_file_atomically(options.out / "faults.csv", coop::chaos::csv_of(result));
    }
    return result.wrong.empty() ? 0 : 1;
  } catch (const std::exception& problem) {
    std::cerr << "chaos: " << problem.what() << '\n';
    return 2;
  }
}
