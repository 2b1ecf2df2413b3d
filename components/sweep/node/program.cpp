#include "sweep/node/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <sstream>

#include "core/config/config.hpp"
#include "runtime/clock.hpp"
#include "runtime/executor.hpp"
#include "runtime/stop_signal.hpp"
#include "sweep/node/claim.hpp"
#include "sweep/node/local_engine.hpp"
#include "sweep/node/progress.hpp"
#include "sweep/node/settled_inputs.hpp"
#include "sweep/node/slurm_engine.hpp"
#include "sweep/report.hpp"

namespace coop::sweep {
namespace {

namespace fs = std::filesystem;
constexpr auto kRound = std::chrono::milliseconds(100);
constexpr int kStopped = 130;

/// A path, or the name of a sweep that comes with Coop: config/sweeps/weights.yaml, weights.
fs::path find_sweep_file(const std::string& wanted, const fs::path& share) {
  fs::path file = find_file(wanted, {".", share});
  if (file.empty()) file = find_file(wanted + ".yaml", {share / "config" / "sweeps"});
  if (file.empty()) throw config::Error("no sweep file '" + wanted + "'");
  return file;
}

std::size_t count_finished(const Sweep& sweep, const std::vector<Run>& runs) {
  return static_cast<std::size_t>(std::ranges::count_if(
      runs, [&](const Run& run) { return fs::exists(result_file(sweep.folder, run)); }));
}

void override_slurm(SlurmSettings& slurm, const ProgramOptions& options) {
  if (options.partition) slurm.partition = *options.partition;
  if (options.time_limit) slurm.time_limit = *options.time_limit;
  if (options.retries) slurm.retries = *options.retries;
  std::istringstream words(options.slurm_options);
  std::copy(std::istream_iterator<std::string>(words), {}, std::back_inserter(slurm.options));
}

Sweep load(const ProgramOptions& options) {
  Sweep sweep;
  sweep.places = Places::of_this_program();
  sweep.file = fs::absolute(find_sweep_file(options.file, sweep.places.share));
  sweep.config = config::Document::load(sweep.file).read<SweepConfig>();
  sweep.folder = fs::absolute(options.folder);
  if (options.seeds) sweep.config.seeds = *options.seeds;
  if (options.first_seed) sweep.config.first_seed = *options.first_seed;
  sweep.config.settings.insert(sweep.config.settings.end(), options.settings.begin(),
                               options.settings.end());
  override_slurm(sweep.config.slurm, options);
  sweep.config.validate();
  sweep.inputs = find_inputs(sweep.config, sweep.places);
  return sweep;
}

/// The runs without success; their old results go, so that a file counts as one of this call.
std::vector<Run> runs_to_make(const Sweep& sweep, const std::vector<Run>& planned,
                              const std::vector<int>& only) {
  std::vector<Run> missing;
  for (const Run& run : planned) {
    if (!only.empty() && std::ranges::find(only, run.number) == only.end()) continue;
    if (is_finished(sweep.folder, sweep.config, run)) continue;
    fs::remove(result_file(sweep.folder, run));
    missing.push_back(run);
  }
  return missing;
}

/// This call for one run; its number is appended.
std::vector<std::string> task_command(const Sweep& sweep, const ProgramOptions& options) {
  std::vector<std::string> words{(sweep.places.programs / "sweep").string(),
                                 sweep.file.string(),
                                 "--output",
                                 sweep.folder.string(),
                                 "--domain",
                                 std::to_string(options.domain),
                                 "--seeds",
                                 std::to_string(sweep.config.seeds),
                                 "--seed",
                                 std::to_string(sweep.config.first_seed)};
  for (const std::string& setting : options.settings) {
    words.insert(words.end(), {"--set", setting});
  }
  words.emplace_back("--only");
  return words;
}

std::unique_ptr<Engine> make_engine(const Sweep& sweep, const ProgramOptions& options) {
  if (options.engine == "slurm") {
    return std::make_unique<SlurmEngine>(
        SlurmEngineOptions{.task = task_command(sweep, options), .side_by_side = options.jobs});
  }
  return std::make_unique<LocalEngine>(options.jobs.value_or(1), options.domain);
}

int report(const Sweep& sweep, const std::vector<Run>& planned) {
  const std::vector<FinishedRun> finished = gather(sweep.folder, sweep.config, planned);
  write_pages(sweep.folder, render_sweep(sweep.config, planned, finished));
  const auto good =
      std::ranges::count_if(finished, [](const FinishedRun& run) { return run.result.success; });
  std::cout << fmt::format("{} of {} runs with a result\nreport: {}\n", good, planned.size(),
                           (sweep.folder / "report.html").string());
  for (const FinishedRun& run : finished) {
    if (run.result.success) continue;
    std::cerr << fmt::format("sweep: run {}: {}\n", run.run.number, run.result.problem);
  }
  if (runtime::StopSignal::requested()) {
    std::cout << "stopped; the same call goes on from here\n";
    return kStopped;
  }
  return static_cast<std::size_t>(good) == planned.size() ? 0 : 1;
}

}  // namespace

int run_sweep(const ProgramOptions& options) {
  // Two machines of one network may make runs in the same domain: a run stays on its own.
  ::setenv("ROS_LOCALHOST_ONLY", "1", 0);
  const Sweep sweep = load(options);
  const bool is_task = !options.only.empty();
  const std::unique_ptr<Engine> engine = make_engine(sweep, options);
  fs::create_directories(sweep.folder);
  const std::optional<Claim> alone = is_task ? std::nullopt : claim_folder(sweep.folder);
  if (!is_task && !alone) {
    throw config::Error("another sweep is at work in " + sweep.folder.string());
  }
  if (options.restart) fs::remove_all(sweep.folder / "runs");
  settle_inputs(sweep, is_task);
  const std::vector<Run> planned = plan_runs(sweep.config);
  const std::vector<Run> missing = runs_to_make(sweep, planned, options.only);

  const runtime::SystemClock clock;
  runtime::Executor executor(clock);
  const runtime::StopSignal signal(executor);
  // A task among many counts only its own.
  const std::vector<Run>& counted = is_task ? missing : planned;
  Progress progress(counted.size(), counted.size() - missing.size());
  engine->make(sweep, missing, [&] {
    if (progress.is_due()) progress.show(count_finished(sweep, counted), engine->status());
    executor.wait_and_run(kRound);
    return !runtime::StopSignal::requested();
  });
  progress.show(count_finished(sweep, counted), "");

  // The report of many tasks is made by the call that gathers.
  if (!is_task) return report(sweep, planned);
  if (runtime::StopSignal::requested()) return kStopped;
  const bool all_good = std::ranges::all_of(
      missing, [&](const Run& run) { return is_finished(sweep.folder, sweep.config, run); });
  return all_good ? 0 : 1;
}

}  // namespace coop::sweep
