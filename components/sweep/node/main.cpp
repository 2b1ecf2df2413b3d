#include <CLI/CLI.hpp>
#include <iostream>

#include "sweep/node/program.hpp"

namespace {

void add_slurm(CLI::App& app, coop::sweep::ProgramOptions& options) {
  CLI::Option* engine = app.add_option("--engine", options.engine,
                                       "where the runs are made: this machine, or a Slurm cluster")
                            ->check(CLI::IsMember({"local", "slurm"}));
  app.add_option("--partition", options.partition, "of the Slurm cluster")->needs(engine);
  app.add_option("--time-limit", options.time_limit,
                 "of a run, as sbatch's --time; default: a little over the sweep's timeout")
      ->needs(engine);
  app.add_option("--slurm-options", options.slurm_options,
                 "further ones of sbatch: --slurm-options='--mem=4G --account=barn'")
      ->needs(engine);
  app.add_option("--retries", options.retries, "submissions of a run that failed, after the first")
      ->check(CLI::Range(0, 100))
      ->needs(engine);
}

}  // namespace

int main(int argc, char** argv) {
  coop::sweep::ProgramOptions options;
  CLI::App app{
      "Runs a launch file over a grid of parameters and seeds, several systems side by side, and "
      "draws what came of it. Called again it goes on where it was stopped.",
      "sweep"};
  app.add_option("file", options.file, "sweep file, or the name of one in config/sweeps")
      ->required();
  app.add_option("-o,--output", options.folder, "folder of the results")->required();
  app.add_option("--jobs", options.jobs,
                 "systems side by side; default: 1, with Slurm what the cluster allows")
      ->check(CLI::Range(1, 1000));
  app.add_option("--domain", options.domain, "first DDS domain; taken are those that are free")
      ->check(CLI::Range(0, 232));
  app.add_option("--seeds,--tests", options.seeds, "runs of each point")
      ->check(CLI::Range(1, 100000));
  app.add_option("--seed", options.first_seed, "of each point's first run")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--set", options.settings, "key=value for every run; may be repeated");
  CLI::Option* restart = app.add_flag("--restart", options.restart,
                                      "remove the runs in the folder and make all of them anew");
  app.add_option("--only", options.only,
                 "make the runs of these numbers and no report: a task of many")
      ->check(CLI::PositiveNumber)
      ->excludes(restart);
  add_slurm(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    return coop::sweep::run_sweep(options);
  } catch (const std::exception& problem) {
    std::cerr << "sweep: " << problem.what() << '\n';
    return 1;
  }
}
