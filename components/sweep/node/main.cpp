#include <CLI/CLI.hpp>
#include <iostream>

#include "sweep/node/program.hpp"

int main(int argc, char** argv) {
  coop::sweep::ProgramOptions options;
  CLI::App app{
      "Runs a launch file over a grid of parameters and seeds, several systems side by side, and "
      "draws what came of it. Called again it goes on where it was stopped.",
      "sweep"};
  app.add_option("file", options.file, "sweep file, or the name of one in config/sweeps")
      ->required();
  app.add_option("-o,--output", options.folder, "folder of the results")->required();
  app.add_option("--jobs", options.jobs, "systems side by side")->check(CLI::Range(1, 64));
  app.add_option("--domain", options.domain, "first of as many DDS domains")
      ->check(CLI::Range(0, 232));
  app.add_option("--engine", options.engine, "where the runs are made")
      ->check(CLI::IsMember({"local"}));
  app.add_option("--seeds,--tests", options.seeds, "runs of each point")
      ->check(CLI::Range(1, 100000));
  app.add_option("--seed", options.first_seed, "of each point's first run")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--set", options.settings, "key=value for every run; may be repeated");
  app.add_option("--only", options.only,
                 "make the runs of these numbers and no report: a task of many")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    return coop::sweep::run_sweep(options);
  } catch (const std::exception& problem) {
    std::cerr << "sweep: " << problem.what() << '\n';
    return 1;
  }
}
